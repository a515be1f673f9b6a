// The binary message of the live view (docs/live-view-format.md), wrapped where it lies: nothing is copied.

export interface Look {
  name: string;
  colour: [number, number, number];
  broken: [number, number, number];
  spread: number;
  roughness: number;
  metallic: number;
  opacity: number;
}

export interface ChargeFacts {
  position_m: [number, number, number];
  tnt_mass_kg: number;
  time_s: number;
  burst: string;
}

interface ArrayPlace {
  type: "f32" | "u32" | "i8";
  at: number;
  shape: number[];
}

export interface Header {
  id?: number;
  server_s?: number;
  name: string;
  seed: number;
  frames: number;
  frame_rate: number;
  step_s: number;
  row: number;
  pieces_a_row: number;
  ground_m: number | null;
  facts: string[];
  names: string[];
  sources: { name: string; material: string; start: number; stop: number }[];
  charges: ChargeFacts[];
  warnings: string[];
  timing_s: Record<string, number>;
  looks: Look[];
  geometry: string;
  batches: { instanced: boolean; transparent: boolean; triangles: number }[] | null;
  arrays: Record<string, ArrayPlace>;
}

export interface Batch {
  instanced: boolean;
  transparent: boolean;
  triangles: number;
  position: Float32Array;
  normal: Int8Array;
  index: Uint32Array;
  piece: Float32Array;
}

export interface Pulse {
  arrival: number;
  peak: number;
  duration: number;
  decay: number;
}

const MAGIC = 0x56535242;
const VERSION = 1;
const CELLS = 16;

export class Recording {
  readonly header: Header;
  readonly poses: Uint32Array;
  readonly table: Float32Array;
  readonly batches: Batch[];
  private readonly facts: Float32Array;
  private readonly pulseTable: Float32Array;
  private readonly fronts: Float32Array;
  private readonly columns: Map<string, number>;

  /** `previous` lends its shapes where the message leaves them out because they are equal. */
  constructor(buffer: ArrayBuffer, previous?: Recording) {
    const head = new DataView(buffer, 0, 16);
    if (head.getUint32(0, true) !== MAGIC || head.getUint32(4, true) !== VERSION) {
      throw new Error("This recording was made by another version of Brisance.");
    }
    if (head.getUint32(12, true) !== buffer.byteLength) throw new Error("This recording is cut short.");
    const size = head.getUint32(8, true);
    this.header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 16, size))) as Header;
    const start = 16 + size;
    const place = (name: string): [number, number] => {
      const found = this.header.arrays[name];
      if (!found) throw new Error(`This recording has no ${name}.`);
      return [start + found.at, found.shape.reduce((product, count) => product * count, 1)];
    };
    const floats = (name: string) => new Float32Array(buffer, ...place(name));
    this.poses = new Uint32Array(buffer, ...place("poses"));
    this.table = floats("pieces");
    this.facts = floats("facts");
    this.pulseTable = floats("pulses");
    this.fronts = floats("fronts");
    this.columns = new Map(this.header.facts.map((name, index) => [name, index]));
    if (this.header.batches) {
      this.batches = this.header.batches.map((batch, index) => ({
        ...batch,
        position: floats(`position_${index}`),
        normal: new Int8Array(buffer, ...place(`normal_${index}`)),
        index: new Uint32Array(buffer, ...place(`index_${index}`)),
        piece: floats(`piece_${index}`),
      }));
    } else if (previous?.header.geometry === this.header.geometry) {
      this.batches = previous.batches;
    } else {
      throw new Error("This recording refers to shapes that are gone.");
    }
  }

  get pieces(): number {
    return this.header.names.length;
  }

  /** Time of the last frame [s]. */
  get duration(): number {
    return (this.header.frames - 1) / this.header.frame_rate;
  }

  /** One fact of one piece; NaN for what never happens. */
  fact(name: string, piece: number): number {
    const column = this.columns.get(name);
    return column === undefined ? Number.NaN : (this.facts[piece * this.columns.size + column] ?? Number.NaN);
  }

  /** Magnitude of the impulse that the blast gave a piece [N s]. */
  impulse(piece: number): number {
    return Math.hypot(...["x", "y", "z"].map((axis) => this.fact(`impulse_${axis}_n_s`, piece)));
  }

  /** The pulse that one charge sends past a piece's first place, in the open. */
  pulse(charge: number, piece: number): Pulse {
    const at = 4 * (charge * this.pieces + piece);
    const [arrival = 0, peak = 0, duration = 0, decay = 0] = this.pulseTable.subarray(at, at + 4);
    return { arrival, peak, duration, decay };
  }

  /** Radius [m] of a charge's shock front at a time [s]; 0 before it detonates. */
  frontRadius(charge: number, time: number): number {
    const samples = this.header.arrays.fronts?.shape[1] ?? 0;
    const first = charge * samples * 2;
    const at = (index: number) => this.fronts[first + 2 * index] ?? 0;
    if (time <= at(0)) return 0;
    let low = 0;
    let high = samples - 1;
    if (time >= at(high)) return this.fronts[first + 2 * high + 1] ?? 0;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (at(middle) <= time) low = middle;
      else high = middle;
    }
    const [t0, t1] = [at(low), at(high)];
    const share = t1 > t0 ? (time - t0) / (t1 - t0) : 1;
    const [r0, r1] = [this.fronts[first + 2 * low + 1] ?? 0, this.fronts[first + 2 * high + 1] ?? 0];
    return r0 + share * (r1 - r0);
  }

  /** Cell of the piece table: what the vertex shader reads, too. */
  cell(piece: number, index: number): number {
    return this.table[piece * CELLS + index] ?? 0;
  }

  sourceOf(piece: number): Header["sources"][number] | undefined {
    return this.header.sources.find((source) => piece >= source.start && piece < source.stop);
  }
}
