// One piece: what the report says of it, and the pressure that passes its place.

import { button, make, shown } from "./dom";
import { speedAt } from "./poses";
import type { Pulse, Recording } from "./recording";

const WIDTH = 272;
const HEIGHT = 112;
const EDGE = { left: 38, right: 6, top: 8, bottom: 20 };

export class PiecePanel {
  readonly element = make("section", { class: "piece", "aria-label": "Piece", hidden: true });
  onClose: () => void = () => {};
  private readonly title = make("h2", { tabindex: -1 });
  private readonly material = make("p", { class: "of" });
  private readonly facts = make("dl");
  private readonly canvas = make("canvas", { width: 2 * WIDTH, height: 2 * HEIGHT, role: "img" });
  private readonly caption = make("p", { class: "caption" });
  private readonly speed = make("dd");
  private recording: Recording | undefined;
  private piece = -1;

  constructor() {
    const close = button("Close", "×", () => this.onClose());
    close.className = "close";
    this.element.append(close, this.title, this.material, this.facts, this.canvas, this.caption);
  }

  show(recording: Recording, piece: number, time: number): void {
    this.recording = recording;
    this.piece = piece;
    this.element.hidden = piece < 0;
    if (piece < 0) return;
    const source = recording.sourceOf(piece);
    this.title.textContent = recording.header.names[piece] ?? "";
    this.material.textContent = source ? `${source.material}, of ${source.name}` : "";
    const row = (name: string, value: number, unit: string, scale = 1) =>
      [
        make("dt", {}, name),
        make("dd", {}, `${shown(value * scale)}${Number.isFinite(value) ? ` ${unit}` : ""}`),
      ] as const;
    const fact = (name: string) => recording.fact(name, piece);
    this.facts.replaceChildren(
      ...row("Mass", fact("mass_kg"), "kg"),
      ...row("Distance", fact("distance_m"), "m"),
      ...row("Arrival", fact("arrival_time_s"), "ms", 1e3),
      ...row("Peak, incident", fact("peak_overpressure_pa"), "kPa", 1e-3),
      ...row("Peak load", fact("peak_load_pa"), "kPa", 1e-3),
      ...row("Impulse", recording.impulse(piece), "N s"),
      ...row("Attenuation", fact("attenuation"), ""),
      ...row("Launch speed", fact("launch_speed_m_s"), "m/s"),
      ...row("At rest", fact("rest_time_s"), "s"),
      make("dt", {}, "Speed now"),
      this.speed,
    );
    this.setTime(time);
  }

  setTime(time: number): void {
    if (!this.recording || this.piece < 0) return;
    const frame = time * this.recording.header.frame_rate;
    this.speed.textContent = `${shown(speedAt(this.recording, this.piece, frame))} m/s`;
    this.plot(this.recording, time);
  }

  private plot(recording: Recording, time: number): void {
    const context = this.canvas.getContext("2d");
    if (!context) return;
    const share = recording.fact("attenuation", this.piece);
    const pulses = recording.header.charges.map((_, charge) => recording.pulse(charge, this.piece));
    const sheltered = Number.isFinite(share) && share < 0.995;
    const what = sheltered
      ? `Incident overpressure at its first place: in the open (dashed), and times its attenuation ${shown(share)}.`
      : "Incident overpressure at its first place, in the open.";
    this.caption.textContent = `${what} Not the load on its faces, which reflect.`;
    this.canvas.setAttribute(
      "aria-label",
      `${what} Peak ${shown(Math.max(...pulses.map((p) => p.peak)) / 1e3)} kPa.`,
    );
    draw(context, pulses, Number.isFinite(share) ? share : 1, time);
  }
}

/** Overpressure [Pa] at a time [s], all charges together. */
export function overpressure(pulses: Pulse[], time: number): number {
  return pulses.reduce((sum, { arrival, peak, duration, decay }) => {
    const x = (time - arrival) / duration;
    return x < 0 || x > 1 ? sum : sum + peak * (1 - x) * Math.exp(-decay * x);
  }, 0);
}

function draw(context: CanvasRenderingContext2D, pulses: Pulse[], share: number, now: number): void {
  const style = getComputedStyle(context.canvas);
  const [ink, faint, accent] = ["--ink", "--line", "--accent"].map((name) =>
    style.getPropertyValue(name),
  ) as [string, string, string];
  const starts = pulses.map((pulse) => pulse.arrival);
  const ends = pulses.map((pulse) => pulse.arrival + pulse.duration);
  const span = Math.max(...ends) - Math.min(...starts) || 1e-3;
  const [from, to] = [Math.max(0, Math.min(...starts) - 0.12 * span), Math.max(...ends) + 0.1 * span];
  const top = 1.08 * Math.max(1, ...pulses.map((pulse) => overpressure(pulses, pulse.arrival)));
  const x = (time: number) => EDGE.left + ((time - from) / (to - from)) * (WIDTH - EDGE.left - EDGE.right);
  const y = (pressure: number) => HEIGHT - EDGE.bottom - (pressure / top) * (HEIGHT - EDGE.top - EDGE.bottom);
  // Samples at even times and on both sides of every arrival, so that fronts stand upright.
  const times = Array.from({ length: 240 }, (_, i) => from + (i / 239) * (to - from));
  for (const start of starts) times.push(start - 1e-9, start + 1e-9);
  times.sort((a, b) => a - b);
  const trace = (factor: number) => {
    context.beginPath();
    for (const time of times) context.lineTo(x(time), y(factor * overpressure(pulses, time)));
  };
  context.setTransform(2, 0, 0, 2, 0, 0);
  context.clearRect(0, 0, WIDTH, HEIGHT);
  context.font = "10px system-ui, sans-serif";
  context.strokeStyle = faint;
  context.strokeRect(EDGE.left, EDGE.top, WIDTH - EDGE.left - EDGE.right, HEIGHT - EDGE.top - EDGE.bottom);
  trace(share);
  context.strokeStyle = accent;
  context.lineWidth = 1.6;
  context.stroke();
  context.lineTo(x(to), y(0));
  context.lineTo(x(from), y(0));
  context.fillStyle = accent;
  context.globalAlpha = 0.2;
  context.fill();
  context.globalAlpha = 1;
  context.lineWidth = 1;
  if (share < 0.995) {
    trace(1);
    context.strokeStyle = ink;
    context.setLineDash([3, 3]);
    context.stroke();
    context.setLineDash([]);
  }
  context.fillStyle = ink;
  context.textAlign = "right";
  context.fillText(shown(top / 1.08e3), EDGE.left - 4, EDGE.top + 12);
  context.fillText("0", EDGE.left - 4, y(0) + 3);
  context.fillText("kPa", EDGE.left - 4, EDGE.top + 25);
  context.textAlign = "left";
  context.fillText(`${shown(1e3 * from)} ms`, EDGE.left, HEIGHT - 6);
  context.textAlign = "right";
  context.fillText(`${shown(1e3 * to)} ms`, WIDTH - EDGE.right, HEIGHT - 6);
  if (now >= from && now <= to) {
    context.strokeStyle = ink;
    context.beginPath();
    context.moveTo(x(now), EDGE.top);
    context.lineTo(x(now), y(0));
    context.stroke();
  }
}
