// The charges: balls of the explosive's size, and a gizmo to drag one by.

import * as THREE from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import type { Recording } from "./recording";

/** Density of cast TNT [kg/m³], from which the drawn size follows. */
const DENSITY = 1630;
/** Radius [m] that a charge is drawn with at least. */
const SMALLEST = 0.09;

export class Charges {
  readonly group = new THREE.Group();
  onDragging: (dragging: boolean) => void = () => {};
  /** Called with the charge and its place while it is dragged, and at the end with `done`. */
  onMoved: (charge: number, place: [number, number, number], done: boolean) => void = () => {};
  private readonly balls = new THREE.Group();
  private readonly gizmo: TransformControls;
  private readonly shape = new THREE.SphereGeometry(1, 32, 24);
  private recording: Recording | undefined;
  private chosen = 0;
  private dragging = false;
  private lowest = Number.NEGATIVE_INFINITY;

  constructor(camera: THREE.Camera, canvas: HTMLElement, changed: () => void) {
    this.gizmo = new TransformControls(camera, canvas);
    this.gizmo.setMode("translate");
    this.gizmo.size = 0.62;
    this.group.add(this.balls, this.gizmo.getHelper());
    this.gizmo.addEventListener("change", changed);
    this.gizmo.addEventListener("dragging-changed", (event) => {
      this.dragging = event.value as boolean;
      this.onDragging(this.dragging);
      if (!this.dragging) this.moved(true);
    });
    this.gizmo.addEventListener("objectChange", () => this.moved(false));
  }

  set gizmoShown(shown: boolean) {
    this.gizmo.getHelper().visible = shown && this.gizmo.object !== undefined;
  }

  set movable(movable: boolean) {
    this.gizmo.enabled = movable;
    if (!movable) this.gizmo.detach();
  }

  get isDragging(): boolean {
    return this.dragging;
  }

  /** Whether the pointer is on the gizmo, so that a click there means no piece. */
  get isPointedAt(): boolean {
    return this.gizmo.axis !== null;
  }

  show(recording: Recording): void {
    this.recording = recording;
    this.lowest = recording.header.ground_m ?? Number.NEGATIVE_INFINITY;
    const { charges } = recording.header;
    while (this.balls.children.length > charges.length) {
      const last = this.balls.children.at(-1) as THREE.Mesh<THREE.BufferGeometry, THREE.Material>;
      last.material.dispose();
      this.balls.remove(last);
    }
    while (this.balls.children.length < charges.length) this.balls.add(this.ball());
    charges.forEach((charge, index) => {
      const ball = this.balls.children[index] as THREE.Mesh;
      const size = Math.cbrt((3 * charge.tnt_mass_kg) / (4 * Math.PI * DENSITY));
      ball.scale.setScalar(Math.max(size, SMALLEST));
      if (!(this.dragging && index === this.chosen)) ball.position.set(...charge.position_m);
    });
    if (this.gizmo.enabled) this.choose(Math.min(this.chosen, charges.length - 1));
  }

  /** Ghosts after their detonation. */
  setTime(time: number): void {
    this.balls.children.forEach((ball, index) => {
      const gone = time > (this.recording?.header.charges[index]?.time_s ?? 0);
      ((ball as THREE.Mesh).material as THREE.MeshStandardMaterial).opacity = gone ? 0.45 : 1;
    });
  }

  /** Give the gizmo to the charge that a ray hits; whether there is one. */
  pick(ray: THREE.Raycaster): boolean {
    const hit = ray.intersectObjects(this.balls.children, false)[0];
    if (!hit || !this.gizmo.enabled) return false;
    this.choose(this.balls.children.indexOf(hit.object));
    return true;
  }

  private choose(index: number): void {
    this.chosen = index;
    const ball = this.balls.children[index];
    if (ball) this.gizmo.attach(ball);
    else this.gizmo.detach();
  }

  private moved(done: boolean): void {
    const ball = this.balls.children[this.chosen];
    if (!ball) return;
    ball.position.y = Math.max(ball.position.y, this.lowest);
    const round = (value: number) => Math.round(value * 1000) / 1000;
    this.onMoved(this.chosen, ball.position.toArray().map(round) as [number, number, number], done);
  }

  private ball(): THREE.Mesh {
    const material = new THREE.MeshStandardMaterial({
      color: 0xd0361c,
      emissive: 0xff5a1f,
      emissiveIntensity: 0.35,
      roughness: 0.45,
      transparent: true,
    });
    const ball = new THREE.Mesh(this.shape, material);
    ball.castShadow = true;
    ball.renderOrder = 1;
    return ball;
  }
}
