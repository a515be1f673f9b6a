// The picture: renderer, camera and everything in it. It is drawn when something has changed and not otherwise.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Charges } from "./charges";
import { Fronts } from "./front";
import { Pieces } from "./pieces";
import { positionAt } from "./poses";
import { rampTexture } from "./ramp";
import { placesOnCard } from "./readback";
import type { Recording } from "./recording";
import { Surroundings, type Theme } from "./surroundings";

/** From the way the blast goes to the way the camera looks from: turned to the right, so that the charge stands beside
 * the pieces and not behind them, and raised [rad]. */
const AZIMUTH = THREE.MathUtils.degToRad(20);
const ELEVATION = THREE.MathUtils.degToRad(11);
/** Pieces looked at to follow the action: of more, every so many-th. */
const WATCHED = 1000;
/** A picture that takes longer than this [ms] has the next drawn more coarsely, one that is quicker more finely. */
const SLOW = 45;
const QUICK = 20;
/** Share of the full resolution at least. */
const COARSEST = 0.4;
/** After this long [ms] without a change, a coarse picture is drawn again in full. */
const STILL = 180;

export class Stage {
  readonly canvas: HTMLCanvasElement;
  readonly pieces: Pieces;
  readonly charges: Charges;
  readonly camera = new THREE.PerspectiveCamera(34, 1, 0.05, 5000);
  /** Called after each frame that was drawn. */
  afterDrawing: () => void = () => {};
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly surroundings: Surroundings;
  private readonly fronts = new Fronts();
  private readonly orbit: OrbitControls;
  private recording: Recording | undefined;
  private radii = new Float32Array(0);
  private frame = 0;
  private coarse = 1;
  private drawnAt = 1;
  private changed = 0;
  private drewBefore = false;
  private dirty = true;

  constructor(host: HTMLElement) {
    this.renderer = new THREE.WebGLRenderer({ antialias: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.renderer.toneMapping = THREE.NeutralToneMapping;
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute(
      "aria-label",
      "The scene. Drag to look around, scroll to come closer, click a piece for its facts.",
    );
    host.append(this.canvas);
    this.pieces = new Pieces(rampTexture());
    this.surroundings = new Surroundings(this.scene, this.renderer, this.pieces.uniforms.noise.value);
    this.orbit = new OrbitControls(this.camera, this.canvas);
    this.orbit.enableDamping = false;
    this.orbit.maxPolarAngle = 0.94 * Math.PI;
    this.orbit.addEventListener("change", () => this.touch());
    this.charges = new Charges(this.camera, this.canvas, () => this.touch());
    this.charges.onDragging = (dragging) => {
      this.orbit.enabled = !dragging;
    };
    this.scene.add(this.pieces.group, this.fronts.group, this.charges.group);
    new ResizeObserver(() => this.resize(host)).observe(host);
    this.resize(host);
  }

  get info(): { drawCalls: number; triangles: number; renderCalls: number; renderTriangles: number } {
    const { calls, triangles } = this.renderer.info.render;
    return {
      drawCalls: this.pieces.drawCalls,
      triangles: this.pieces.triangles,
      renderCalls: calls,
      renderTriangles: triangles,
    };
  }

  /** Longest side of a texture that this graphics card takes. */
  get largestTexture(): number {
    return this.renderer.capabilities.maxTextureSize;
  }

  /** Show a recording; `fresh` for another scene, where the camera is placed anew. */
  show(recording: Recording, fresh: boolean): void {
    if (this.recording?.batches !== recording.batches) this.radii = pieceRadii(recording);
    this.recording = recording;
    this.pieces.show(recording);
    this.fronts.show(recording);
    this.charges.show(recording);
    this.surroundings.setGround(recording.header.ground_m);
    if (fresh) {
      this.surroundings.setBlastDirection(this.blastDirection());
      this.frameAll();
    }
    this.setFrame(Math.min(this.frame, recording.header.frames - 1));
  }

  setTheme(theme: Theme): void {
    this.surroundings.setTheme(theme);
    this.fronts.setTheme(theme === "dark");
    this.touch();
  }

  /** Show the time of a frame, which may lie between two. */
  setFrame(frame: number): void {
    this.frame = frame;
    this.pieces.uniforms.frame.value = frame;
    if (this.recording) {
      const time = frame / this.recording.header.frame_rate;
      this.fronts.setTime(time);
      this.charges.setTime(time);
      const { centre, radius } = this.action(frame);
      this.surroundings.follow(centre, radius);
    }
    this.touch();
  }

  select(piece: number): void {
    this.pieces.uniforms.selected.value = piece;
    this.touch();
  }

  /** Piece under a point of the page, or -1. */
  pick(clientX: number, clientY: number): number {
    const box = this.canvas.getBoundingClientRect();
    const found = this.pieces.pick(this.renderer, this.camera, clientX - box.left, clientY - box.top);
    this.touch();
    return found;
  }

  /** Where the graphics card puts the pieces at the frame now shown, x y z of each [m]. */
  placesOnCard(): Float32Array {
    return placesOnCard(this.renderer, this.pieces.uniforms, this.recording?.pieces ?? 0);
  }

  /** Point of the page at which a place [m] is seen. */
  onPage(place: [number, number, number]): [number, number] {
    const seen = new THREE.Vector3(...place).project(this.camera);
    const box = this.canvas.getBoundingClientRect();
    return [box.left + ((seen.x + 1) / 2) * box.width, box.top + ((1 - seen.y) / 2) * box.height];
  }

  /** Look at one piece, or at everything. */
  lookAt(piece: number): void {
    if (piece < 0 || !this.recording) {
      this.frameAll();
      return;
    }
    const at = new Float64Array(3);
    positionAt(this.recording, piece, this.frame, at);
    const radius = Math.max(0.15, this.radii[piece] ?? 0.15);
    const away = this.camera.position.clone().sub(this.orbit.target).normalize();
    this.aim(new THREE.Vector3(...at), 3 * radius, away);
  }

  /** Something has changed: draw before long. */
  touch(): void {
    this.dirty = true;
  }

  /**
   * Draw if anything has changed. `now` is the page's clock and `spent` the time since the last call [ms]. Where
   * pictures take long they are drawn coarsely as long as something changes, and in full as soon as nothing does.
   */
  draw(now: number, spent: number): void {
    if (this.drewBefore && spent > SLOW) this.coarse = Math.max(COARSEST, this.coarse * 0.8);
    else if (this.drewBefore && spent < QUICK) this.coarse = Math.min(1, this.coarse * 1.05);
    this.drewBefore = this.dirty;
    if (this.dirty) {
      this.changed = now;
      this.render(this.coarse);
      this.afterDrawing();
    } else if (!this.isFine && now - this.changed > STILL) {
      this.render(1);
    }
  }

  /** Whether the picture is as it will stay. */
  get isFine(): boolean {
    return this.drawnAt === 1 && !this.dirty;
  }

  private render(scale: number): void {
    if (scale !== this.drawnAt) {
      this.drawnAt = scale;
      this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2) * scale);
    }
    this.dirty = false;
    this.renderer.render(this.scene, this.camera);
  }

  /** The picture as PNG. */
  png(): Promise<Blob> {
    this.charges.gizmoShown = false;
    this.render(1);
    const url = this.canvas.toDataURL("image/png");
    this.charges.gizmoShown = true;
    this.touch();
    const bytes = Uint8Array.from(atob(url.slice(url.indexOf(",") + 1)), (c) => c.charCodeAt(0));
    return Promise.resolve(new Blob([bytes], { type: "image/png" }));
  }

  private resize(host: HTMLElement): void {
    const { clientWidth: width, clientHeight: height } = host;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2) * this.drawnAt);
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    // A narrow picture is opened up, so that as much fits across.
    this.camera.fov = width > height ? 34 : Math.min(62, 34 * Math.sqrt(height / width));
    this.camera.updateProjectionMatrix();
    // A canvas of another size is empty until it is drawn.
    this.render(this.drawnAt);
  }

  private frameAll(): void {
    if (!this.recording) return;
    const start = this.action(0);
    const later = this.action((this.recording.header.frames - 1) * 0.6);
    const radius = Math.min(Math.max(start.radius, 0.55 * later.radius), 3 * start.radius);
    const along = this.blastDirection();
    const away = along.clone().applyAxisAngle(new THREE.Vector3(0, 1, 0), AZIMUTH);
    away.multiplyScalar(Math.cos(ELEVATION)).setY(Math.sin(ELEVATION));
    const centre = start.centre.clone().addScaledVector(along, 0.45 * (radius - start.radius));
    this.aim(centre, radius, away);
  }

  private aim(centre: THREE.Vector3, radius: number, away: THREE.Vector3): void {
    const half = THREE.MathUtils.degToRad(this.camera.fov) / 2;
    const narrow = Math.min(half, Math.atan(Math.tan(half) * this.camera.aspect));
    this.orbit.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(away, (1.3 * radius) / Math.sin(narrow));
    this.orbit.update();
    this.touch();
  }

  /** Horizontal unit vector from the first charge to the pieces. */
  private blastDirection(): THREE.Vector3 {
    const charge = this.recording?.header.charges[0];
    const along = this.action(0).centre;
    if (charge) along.sub(new THREE.Vector3(...charge.position_m));
    along.y = 0;
    return along.length() > 1e-6 ? along.normalize() : new THREE.Vector3(0, 0, 1);
  }

  /** A sphere around most pieces at a frame. */
  private action(frame: number): { centre: THREE.Vector3; radius: number } {
    const recording = this.recording;
    const centre = new THREE.Vector3();
    if (!recording || recording.pieces === 0) return { centre, radius: 5 };
    const stride = Math.ceil(recording.pieces / WATCHED);
    const at = new Float64Array(3);
    const places: THREE.Vector3[] = [];
    for (let piece = 0; piece < recording.pieces; piece += stride) {
      positionAt(recording, piece, frame, at);
      places.push(new THREE.Vector3(...at));
    }
    for (const place of places) centre.addScaledVector(place, 1 / places.length);
    const reach = places.map((place, index) => place.distanceTo(centre) + (this.radii[index * stride] ?? 0));
    reach.sort((a, b) => a - b);
    return { centre, radius: Math.max(0.3, reach[Math.floor(0.9 * (reach.length - 1))] ?? 1) };
  }
}

/** Radius [m] about its centre of mass that holds each piece. */
function pieceRadii(recording: Recording): Float32Array<ArrayBuffer> {
  const radii = new Float32Array(recording.pieces);
  for (const batch of recording.batches) {
    const { position, piece } = batch;
    let largest = 0;
    for (let i = 0; i < position.length / 3; i++) {
      const radius = Math.hypot(position[3 * i] ?? 0, position[3 * i + 1] ?? 0, position[3 * i + 2] ?? 0);
      if (batch.instanced) largest = Math.max(largest, radius);
      else radii[piece[i] ?? 0] = Math.max(radii[piece[i] ?? 0] ?? 0, radius);
    }
    if (batch.instanced) for (const number of piece) radii[number] = largest;
  }
  return radii;
}
