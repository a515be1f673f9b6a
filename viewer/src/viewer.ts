// A recording on the page: picture, play head, piece, colours and keys. It works with a server or without one.

import * as THREE from "three";
import { Colouring } from "./colouring";
import { listenToKeys } from "./keyboard";
import { Page } from "./page";
import { PiecePanel } from "./panel";
import { Recording } from "./recording";
import { Stage } from "./stage";
import { Timeline } from "./timeline";

/** A press that moves less than this [pixels] is a click. */
const STILL = 4;

export class Viewer {
  readonly page: Page;
  readonly stage: Stage;
  readonly timeline = new Timeline();
  recording: Recording | undefined;
  selected = -1;
  private readonly panel = new PiecePanel();
  private readonly colouring: Colouring;
  private lastFrame = 0;

  constructor(host: HTMLElement, live: boolean) {
    let themed: (theme: "dark" | "light") => void = () => {};
    this.page = new Page(host, live, (theme) => themed(theme));
    this.stage = new Stage(this.page.view);
    themed = (theme) => this.stage.setTheme(theme);
    themed(this.page.theme);
    this.stage.charges.movable = live;
    this.colouring = new Colouring(this.stage);
    this.page.overlay.append(this.panel.element, this.colouring.element);
    this.page.foot.append(this.timeline.element);
    this.timeline.onTime = (time) => this.showTime(time);
    this.panel.onClose = () => this.select(-1);
    this.listen();
    const tick = (now: number) => {
      const spent = now - this.lastFrame;
      this.lastFrame = now;
      this.timeline.advance(Math.min(spent, 250) / 1000);
      this.stage.draw(now, spent);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  /** Show a message; `fresh` for another scene, of which nothing is to stay as it was. */
  show(message: ArrayBuffer, fresh: boolean): Recording {
    const recording = new Recording(message, this.recording);
    const rows = recording.poses.length / (3 * recording.header.row);
    if (rows > this.stage.largestTexture) {
      throw new Error(
        "This recording has more poses than this graphics card holds; lower the frame rate or duration.",
      );
    }
    const name = this.recording?.header.names[this.selected];
    this.recording = recording;
    this.stage.show(recording, fresh);
    const arrivals = recording.header.charges.map((_, charge) => firstArrival(recording, charge));
    this.timeline.show(recording.duration, recording.header.frame_rate, arrivals);
    this.colouring.show(recording);
    // The selection follows the piece's name; where it is gone, nothing is selected.
    this.select(fresh || name === undefined ? -1 : recording.header.names.indexOf(name));
    this.page.name.textContent = recording.header.name;
    document.title = `${recording.header.name} · Brisance`;
    return recording;
  }

  select(piece: number): void {
    this.selected = piece;
    this.stage.select(piece);
    if (this.recording) this.panel.show(this.recording, piece, this.timeline.time);
  }

  private showTime(time: number): void {
    if (!this.recording) return;
    this.stage.setFrame(time * this.recording.header.frame_rate);
    this.panel.setTime(time);
  }

  private listen(): void {
    const { stage, timeline } = this;
    let pressed: PointerEvent | undefined;
    stage.canvas.addEventListener("pointerdown", (event) => {
      pressed = stage.charges.isPointedAt ? undefined : event;
    });
    stage.canvas.addEventListener("pointerup", (event) => {
      if (!pressed || Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) > STILL)
        return;
      if (!this.pickCharge(event)) this.select(stage.pick(event.clientX, event.clientY));
    });
    listenToKeys({
      " ": () => timeline.toggle(),
      ",": () => timeline.step(-1),
      ".": () => timeline.step(1),
      ArrowLeft: () => timeline.leap(-1),
      ArrowRight: () => timeline.leap(1),
      ArrowUp: () => timeline.shift(-1),
      ArrowDown: () => timeline.shift(1),
      Home: () => timeline.toFrame(0),
      End: () => timeline.toFrame(Number.POSITIVE_INFINITY),
      f: () => stage.lookAt(this.selected),
      Escape: () => this.select(-1),
    });
  }

  private pickCharge(event: PointerEvent): boolean {
    const box = this.stage.canvas.getBoundingClientRect();
    const place = new THREE.Vector2(
      ((event.clientX - box.left) / box.width) * 2 - 1,
      1 - ((event.clientY - box.top) / box.height) * 2,
    );
    const ray = new THREE.Raycaster();
    ray.setFromCamera(place, this.stage.camera);
    return this.stage.charges.pick(ray);
  }
}

function firstArrival(recording: Recording, charge: number): number {
  let first = Number.POSITIVE_INFINITY;
  for (let piece = 0; piece < recording.pieces; piece++) {
    first = Math.min(first, recording.pulse(charge, piece).arrival);
  }
  return first;
}
