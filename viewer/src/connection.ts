// The conversation with the server: scenes go out, recordings come back, and only the newest counts.

export type Tables = Record<string, unknown>;

export interface Answer {
  message?: ArrayBuffer;
  error?: string;
  /** When the request was made, and when its answer had come [ms of the page's clock]. */
  asked: number;
  heard: number;
}

const PATIENCE = 1000;

export class Connection {
  /** Frames done and all frames of the newest request; null when nothing runs. */
  onProgress: (progress: [number, number] | null) => void = () => {};
  onAnswer: (answer: Answer) => void = () => {};
  /** Whether the server is there. */
  onState: (open: boolean) => void = () => {};
  private socket: WebSocket | undefined;
  private newest = 0;
  private asked = 0;
  private busy = false;
  private waiting: (() => Tables) | undefined;
  private last: (() => Tables) | undefined;

  constructor() {
    this.open();
  }

  get isBusy(): boolean {
    return this.busy;
  }

  /** Ask for a scene now; whatever runs is called off. */
  ask(request: () => Tables): void {
    this.waiting = undefined;
    this.last = request;
    if (this.socket?.readyState !== WebSocket.OPEN) return;
    this.newest += 1;
    this.busy = true;
    this.asked = performance.now();
    this.socket.send(JSON.stringify({ id: this.newest, ...request() }));
  }

  /** Ask as soon as the one that runs is done, so that dragging shows what can be shown in the meantime. */
  askWhenIdle(request: () => Tables): void {
    if (this.busy) this.waiting = request;
    else this.ask(request);
  }

  private open(): void {
    const socket = new WebSocket(`${location.origin.replace(/^http/, "ws")}/api/live`);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.addEventListener("open", () => {
      this.onState(true);
      if (this.last) this.ask(this.last);
    });
    socket.addEventListener("message", (event: MessageEvent<string | ArrayBuffer>) => this.hear(event.data));
    socket.addEventListener("close", () => {
      this.busy = false;
      this.onProgress(null);
      this.onState(false);
      setTimeout(() => this.open(), PATIENCE);
    });
  }

  private hear(data: string | ArrayBuffer): void {
    const heard = performance.now();
    if (typeof data !== "string") {
      if (idOf(data) === this.newest) this.done({ message: data, asked: this.asked, heard });
      return;
    }
    const told = JSON.parse(data) as { id: number | null; error?: string; progress?: [number, number] };
    if (told.id !== this.newest && told.id !== null) return;
    if (told.progress) this.onProgress(told.progress);
    if (told.error !== undefined) this.done({ error: told.error, asked: this.asked, heard });
  }

  private done(answer: Answer): void {
    this.busy = false;
    this.onProgress(null);
    this.onAnswer(answer);
    if (this.waiting) this.ask(this.waiting);
  }
}

/** The id in a message's header, found without reading all of it. */
function idOf(message: ArrayBuffer): number {
  const size = new DataView(message).getUint32(8, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(message, 16, size))) as { id?: number };
  return header.id ?? -1;
}

/** A question by HTTP; what the server says of a failure is the error's message. */
export async function fetched(path: string, body?: Tables): Promise<Response> {
  const response = await fetch(
    path,
    body && { method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(body) },
  );
  if (response.ok) return response;
  const text = await response.text();
  let sentence = text;
  try {
    sentence = (JSON.parse(text) as { error?: string }).error ?? text;
  } catch {
    sentence = text || response.statusText;
  }
  throw new Error(sentence);
}
