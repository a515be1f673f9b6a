// The live view: controls and gizmo change the scene, the server simulates it, the viewer shows what comes back.

import { Connection, fetched, type Tables } from "./connection";
import { Controls } from "./controls";
import { make, shown } from "./dom";
import { saveMenu } from "./save";
import type { Schema } from "./schema";
import { Viewer } from "./viewer";

export interface Timing {
  /** From asking to the answer [ms]. */
  answer: number;
  /** Of it, the server's work: simulating, and all of it until the message was made. */
  simulated: number;
  /** Decoding and uploading [ms]. */
  decoded: number;
  /** From asking to the first new frame on the canvas [ms]. */
  total: number;
  bytes: number;
}

export class LiveView {
  readonly viewer: Viewer;
  readonly timings: Timing[] = [];
  error = "";
  private readonly connection = new Connection();
  private controls: Controls | undefined;
  private file = "";
  private fresh = true;
  private readonly list = make("select", { "aria-label": "Scene to open", class: "scenes" });

  constructor(host: HTMLElement) {
    this.viewer = new Viewer(host, true);
    const { page, stage } = this.viewer;
    page.tools.prepend(
      this.list,
      saveMenu(
        {
          request: () => ({ file: this.file, scene: this.controls?.scene ?? {} }),
          picture: () => stage.png(),
          name: () => (this.viewer.recording?.header.name ?? "scene").replace(/[^\w-]+/g, "_"),
          failed: (sentence) => page.complain(sentence),
        },
        true,
      ),
    );
    this.list.addEventListener("change", () => void this.open(this.list.value));
    this.connection.onProgress = (progress) => page.showProgress(progress);
    this.connection.onState = (open) => page.say(open ? "" : "Waiting for the server …");
    this.connection.onAnswer = (answer) => {
      if (answer.error !== undefined) this.complain(answer.error);
      if (answer.message) this.answered(answer.message, answer.asked, answer.heard);
    };
    stage.charges.onMoved = (charge, place, done) => {
      this.controls?.set(["charge", charge, "position"], place);
      this.ask(done);
    };
    void this.begin();
  }

  get scene(): Tables {
    return this.controls?.scene ?? {};
  }

  /** Open a scene of the folder. */
  async open(file: string): Promise<void> {
    try {
      const opened = (await (await fetched(`/api/scenes/${encodeURIComponent(file)}`)).json()) as {
        scene: Tables;
      };
      this.file = file;
      this.fresh = true;
      this.list.value = file;
      this.controls?.show(opened.scene);
      this.ask(true);
    } catch (error) {
      this.complain(error instanceof Error ? error.message : String(error));
    }
  }

  private async begin(): Promise<void> {
    try {
      const [schema, scenes] = await Promise.all(
        ["/api/schema", "/api/scenes"].map((path) => fetched(path).then((r) => r.json())),
      );
      this.controls = new Controls(schema as Schema);
      this.controls.onChange = (done) => this.ask(done);
      this.viewer.page.side.append(this.controls.element);
      const { scenes: names, first } = scenes as { scenes: string[]; first: string };
      this.list.append(...names.map((name) => make("option", { value: name }, name.replace(/\.toml$/, ""))));
      await this.open(first);
    } catch (error) {
      this.complain(error instanceof Error ? error.message : String(error));
    }
  }

  /** Have the scene simulated: at once when a control is let go, when there is time while it is turned. */
  private ask(done: boolean): void {
    const request = () => ({
      file: this.file,
      scene: this.scene,
      have: this.viewer.recording?.header.geometry ?? "",
    });
    if (done) this.connection.ask(request);
    else this.connection.askWhenIdle(request);
  }

  private complain(sentence: string): void {
    this.error = sentence;
    this.viewer.page.complain(sentence);
    this.controls?.blame(sentence);
  }

  private answered(message: ArrayBuffer, asked: number, heard: number): void {
    const { page, stage, timeline } = this.viewer;
    const started = performance.now();
    try {
      const fresh = this.fresh;
      const recording = this.viewer.show(message, fresh);
      this.fresh = false;
      this.complain("");
      const decoded = performance.now() - started;
      stage.afterDrawing = () => {
        stage.afterDrawing = () => {};
        const { header } = recording;
        const total = performance.now() - asked;
        this.timings.push({
          answer: heard - asked,
          simulated: 1000 * (header.server_s ?? 0),
          decoded,
          total,
          bytes: message.byteLength,
        });
        page.say(
          `${header.names.length.toLocaleString("en")} pieces · ${header.frames} frames · ${shown(total)} ms${
            header.warnings.length > 0 ? ` · ${header.warnings.length} warnings` : ""
          }`,
        );
      };
      if (fresh) {
        timeline.toFrame(0);
        if (!matchMedia("(prefers-reduced-motion: reduce)").matches) timeline.play();
      }
    } catch (error) {
      this.complain(error instanceof Error ? error.message : String(error));
    }
  }
}
