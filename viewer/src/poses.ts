// Poses on the processor: the same decoding and the same interpolation as in the vertex shader (shaders.ts).

import type { Recording } from "./recording";

export interface Pose {
  /** Centre of mass in the world [m]. */
  position: [number, number, number];
  /** Rotation from body to world, w x y z. */
  orientation: [number, number, number, number];
}

const POSITION_STEPS = 2 ** 18 - 1;
const TURN_STEPS = 2 ** 13 - 1;

/** Pose of a piece at a frame, which may lie between two recorded ones. */
export function poseAt(recording: Recording, piece: number, frame: number): Pose {
  const before = Math.floor(frame);
  const share = moved(recording, piece, frame);
  const first = decode(recording, piece, before);
  if (share === 0) return first;
  const second = decode(recording, piece, before + 1);
  const position = mix(first.position, second.position, share);
  const dot = first.orientation.reduce(
    (sum, value, index) => sum + value * (second.orientation[index] ?? 0),
    0,
  );
  const turned = second.orientation.map((value) => (dot < 0 ? -value : value));
  const orientation = mix(first.orientation, turned, share);
  const length = Math.hypot(...orientation);
  return {
    position: position as Pose["position"],
    orientation: orientation.map((value) => value / length) as Pose["orientation"],
  };
}

/** Position alone, for what runs over all pieces at every frame. */
export function positionAt(recording: Recording, piece: number, frame: number, out: Float64Array): void {
  const before = Math.floor(frame);
  const share = moved(recording, piece, frame);
  const here = 3 * place(recording, piece, before);
  const there = 3 * place(recording, piece, before + 1);
  for (let axis = 0; axis < 3; axis++) {
    const a = (recording.poses[here + axis] ?? 0) & POSITION_STEPS;
    const b = (recording.poses[there + axis] ?? 0) & POSITION_STEPS;
    const steps = a + share * (b - a);
    out[axis] = recording.cell(piece, axis) + (steps / POSITION_STEPS) * recording.cell(piece, 4 + axis);
  }
}

/** Speed of a piece [m/s] between the frames around a time. */
export function speedAt(recording: Recording, piece: number, frame: number): number {
  const last = recording.header.frames - 1;
  const before = Math.min(Math.floor(frame), Math.max(0, last - 1));
  const [a, b] = [new Float64Array(3), new Float64Array(3)];
  positionAt(recording, piece, before, a);
  positionAt(recording, piece, before + 1, b);
  const apart = Math.hypot((b[0] ?? 0) - (a[0] ?? 0), (b[1] ?? 0) - (a[1] ?? 0), (b[2] ?? 0) - (a[2] ?? 0));
  return apart * recording.header.frame_rate;
}

/** How far a piece is from the frame before to the one after. One that the front sets off in between begins then. */
function moved(recording: Recording, piece: number, frame: number): number {
  const before = Math.floor(frame);
  const arrival = recording.cell(piece, 3) * recording.header.frame_rate;
  if (recording.cell(piece, 8) === before && arrival > before && arrival < before + 1) {
    return Math.max(0, (frame - arrival) / (before + 1 - arrival));
  }
  return frame - before;
}

function place(recording: Recording, piece: number, frame: number): number {
  const [offset, first, count] = [7, 8, 9].map((cell) => recording.cell(piece, cell)) as [
    number,
    number,
    number,
  ];
  return offset + Math.min(Math.max(frame - first, 0), count - 1);
}

function decode(recording: Recording, piece: number, frame: number): Pose {
  const at = 3 * place(recording, piece, frame);
  const words = [0, 1, 2].map((axis) => recording.poses[at + axis] ?? 0);
  const position = words.map((word, axis) => {
    const steps = (word & POSITION_STEPS) / POSITION_STEPS;
    return recording.cell(piece, axis) + steps * recording.cell(piece, 4 + axis);
  });
  const three = words.map((word) => ((((word >>> 18) & TURN_STEPS) / TURN_STEPS) * 2 - 1) * Math.SQRT1_2);
  const leftOut = ((words[0] ?? 0) >>> 31) + 2 * ((words[1] ?? 0) >>> 31);
  const orientation = [...three];
  const rest = Math.sqrt(Math.max(0, 1 - three.reduce((sum, value) => sum + value * value, 0)));
  orientation.splice(leftOut, 0, rest);
  return { position: position as Pose["position"], orientation: orientation as Pose["orientation"] };
}

function mix(a: readonly number[], b: readonly number[], share: number): number[] {
  return a.map((value, index) => value + share * ((b[index] ?? 0) - value));
}
