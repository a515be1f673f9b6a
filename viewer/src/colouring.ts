// Colour by a fact, with a legend that says what and from where to where.

import { make, shown } from "./dom";
import { speedAt } from "./poses";
import { RAMP_CSS } from "./ramp";
import type { Recording } from "./recording";
import type { Stage } from "./stage";

interface Way {
  name: string;
  unit: string;
  scale: number;
  of: (recording: Recording, piece: number) => number;
}

const WAYS: Record<string, Way> = {
  arrival: { name: "Arrival", unit: "ms", scale: 1e3, of: (r, p) => r.fact("arrival_time_s", p) },
  impulse: { name: "Impulse", unit: "N s", scale: 1, of: (r, p) => r.impulse(p) },
  attenuation: { name: "Attenuation", unit: "", scale: 1, of: (r, p) => r.fact("attenuation", p) },
  speed: { name: "Speed", unit: "m/s", scale: 1, of: () => Number.NaN },
};

export class Colouring {
  readonly element = make("div", { class: "colouring" });
  private readonly select = make("select", { "aria-label": "Colour by" });
  private readonly legend = make("div", { class: "legend", role: "img" });
  private recording: Recording | undefined;

  constructor(private readonly stage: Stage) {
    this.select.append(make("option", { value: "" }, "Materials"));
    for (const [key, way] of Object.entries(WAYS))
      this.select.append(make("option", { value: key }, way.name));
    this.select.addEventListener("change", () => this.apply());
    this.element.append(make("label", {}, make("span", {}, "Colour"), this.select), this.legend);
    this.legend.hidden = true;
  }

  show(recording: Recording): void {
    this.recording = recording;
    this.apply();
  }

  private apply(): void {
    const way = WAYS[this.select.value];
    this.legend.hidden = !way;
    const { recording, stage } = this;
    if (!recording) return;
    if (!way) {
      stage.pieces.colour(null);
    } else if (this.select.value === "speed") {
      const range: [number, number] = [0, fastest(recording) || 1];
      stage.pieces.colour("speed", range);
      this.say(way, range);
    } else {
      const values = Float32Array.from({ length: recording.pieces }, (_, piece) => way.of(recording, piece));
      const range = rangeOf(values);
      stage.pieces.colour(values, range);
      this.say(way, range);
    }
    stage.touch();
  }

  private say(way: Way, [low, high]: [number, number]): void {
    const unit = way.unit && ` ${way.unit}`;
    const [from, to] = [shown(low * way.scale), shown(high * way.scale)];
    this.legend.setAttribute("aria-label", `${way.name} from ${from} to ${to}${unit}`);
    this.legend.replaceChildren(
      make("b", {}, `${way.name}${way.unit && ` [${way.unit}]`}`),
      make("i", { style: `background:${RAMP_CSS}` }),
      make("span", {}, from),
      make("span", {}, to),
    );
  }
}

function rangeOf(values: Float32Array): [number, number] {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  if (low > high) return [0, 1];
  return low === high ? [low, low + Math.max(1e-6, Math.abs(low) * 1e-3)] : [low, high];
}

/** The highest speed [m/s] at a dozen moments: enough for the end of a scale that does not change while playing. */
function fastest(recording: Recording): number {
  let most = 0;
  const frames = recording.header.frames - 1;
  const stride = Math.ceil(recording.pieces / 2000);
  for (let moment = 0; moment <= 12; moment++) {
    for (let piece = 0; piece < recording.pieces; piece += stride) {
      most = Math.max(most, speedAt(recording, piece, Math.round((moment / 12) * frames)));
    }
  }
  return most;
}
