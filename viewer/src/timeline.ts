// The play head: play, pause, scrub, single frames, and speeds down to a thousandth, since blast footage is slow motion.

import { button, icon, make, shown } from "./dom";

export const SPEEDS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

const PLAY = "M7 4v16l13-8z";
const PAUSE = "M6 4h4v16H6zM14 4h4v16h-4z";
const FIRST = "M5 5h2.5v14H5zM20 5v14L8.5 12z";
const LAST = "M16.5 5H19v14h-2.5zM4 5v14l11.5-7z";
const BACK = "M15 5v14L5 12zM17 5h2v14h-2z";
const ON = "M9 5v14l10-7zM5 5h2v14H5z";
/** Share of the whole that the arrows leap. */
const LEAP = 1 / 20;
/** Seconds of the viewer's time that the last frame stays before playing begins again. */
const REST = 0.7;

export class Timeline {
  readonly element = make("div", { class: "timeline", role: "group", "aria-label": "Timeline" });
  /** Called whenever the shown time changes [s]. */
  onTime: (time: number) => void = () => {};
  private readonly playing = button("Play", icon(PLAY), () => this.toggle());
  private readonly slider = make("input", {
    type: "range",
    min: 0,
    step: "any",
    value: 0,
    "aria-label": "Time",
  });
  private readonly speed = make("select", { "aria-label": "Speed" });
  private readonly clock = make("output", { class: "clock", "aria-live": "off" });
  private readonly marks = make("div", { class: "marks", "aria-hidden": true });
  private duration = 0;
  private rate = 1;
  private now = 0;
  private runs = false;
  private rested = 0;

  constructor() {
    for (const slower of SPEEDS) {
      this.speed.append(make("option", { value: slower }, slower === 1 ? "1×" : `1/${slower}×`));
    }
    this.speed.value = "20";
    this.slider.addEventListener("input", () => {
      this.pause();
      this.seek(Number(this.slider.value));
    });
    this.element.append(
      make(
        "div",
        { class: "buttons" },
        button("First frame (Home)", icon(FIRST), () => this.toFrame(0)),
        button("Frame back (,)", icon(BACK), () => this.step(-1)),
        this.playing,
        button("Frame on (.)", icon(ON), () => this.step(1)),
        button("Last frame (End)", icon(LAST), () => this.toFrame(this.frames - 1)),
      ),
      make("div", { class: "track" }, this.marks, this.slider),
      this.clock,
      this.speed,
    );
  }

  get time(): number {
    return this.now;
  }

  get isPlaying(): boolean {
    return this.runs;
  }

  private get frames(): number {
    return Math.round(this.duration * this.rate) + 1;
  }

  /** Another recording: its length [s], frames a second, and when its fronts arrive [s]. The play head stays. */
  show(duration: number, rate: number, arrivals: number[]): void {
    this.duration = duration;
    this.rate = rate;
    this.slider.max = String(duration);
    this.marks.replaceChildren(
      ...arrivals
        .filter((time) => time >= 0 && time <= duration)
        .map((time) => make("i", { style: `left:${(100 * time) / Math.max(duration, 1e-9)}%` })),
    );
    this.seek(this.now);
  }

  seek(time: number): void {
    this.now = Math.min(Math.max(time, 0), this.duration);
    this.slider.value = String(this.now);
    const frame = Math.round(this.now * this.rate);
    this.clock.value = `${(1000 * this.now).toFixed(this.duration < 0.1 ? 2 : 1)} ms · frame ${frame}`;
    this.slider.setAttribute("aria-valuetext", `${shown(1000 * this.now)} milliseconds, frame ${frame}`);
    this.onTime(this.now);
  }

  toggle(): void {
    if (this.runs) this.pause();
    else this.play();
  }

  play(): void {
    if (this.now >= this.duration) this.seek(0);
    this.setRunning(true);
  }

  pause(): void {
    this.setRunning(false);
  }

  step(frames: number): void {
    const place = this.now * this.rate;
    this.toFrame(frames > 0 ? Math.floor(place + 1e-6) + frames : Math.ceil(place - 1e-6) + frames);
  }

  leap(way: number): void {
    this.pause();
    this.seek(this.now + way * LEAP * this.duration);
  }

  toFrame(frame: number): void {
    this.pause();
    this.seek(Math.min(Math.max(frame, 0), this.frames - 1) / this.rate);
  }

  /** Play faster (-1) or slower (1). */
  shift(way: number): void {
    const index = SPEEDS.indexOf(Number(this.speed.value)) + way;
    this.speed.value = String(SPEEDS[Math.min(Math.max(index, 0), SPEEDS.length - 1)]);
  }

  /** Move on by seconds of the viewer's time. */
  advance(seconds: number): void {
    if (!this.runs || this.duration === 0) return;
    if (this.now >= this.duration) {
      this.rested += seconds;
      if (this.rested < REST) return;
      this.seek(0);
    }
    this.rested = 0;
    this.seek(this.now + seconds / Number(this.speed.value));
  }

  private setRunning(runs: boolean): void {
    this.runs = runs;
    const name = runs ? "Pause" : "Play";
    this.playing.replaceChildren(icon(runs ? PAUSE : PLAY));
    this.playing.setAttribute("aria-label", name);
    this.playing.title = `${name} (space)`;
  }
}
