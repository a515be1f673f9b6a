// All pieces of a recording: a draw call a batch, their poses in a texture, nothing to do between frames but one number.

import * as THREE from "three";
import {
  MOST_LOOKS,
  noiseTexture,
  numberMaterial,
  pieceMaterial,
  shadowMaterial,
  type Uniforms,
} from "./looks";
import type { Batch, Recording } from "./recording";

export class Pieces {
  /** What the picture shows. */
  readonly group = new THREE.Group();
  readonly uniforms: Uniforms;
  private readonly picking = new THREE.Scene();
  private readonly solid: THREE.Material;
  private readonly clear: THREE.Material;
  private readonly shadow: THREE.Material;
  private readonly number: THREE.Material;
  private readonly pixel = new THREE.WebGLRenderTarget(1, 1);
  private geometries: THREE.BufferGeometry[] = [];
  private shown: Recording | undefined;

  constructor(ramp: THREE.Texture) {
    const colours = () => Array.from({ length: MOST_LOOKS }, () => new THREE.Vector4());
    this.uniforms = {
      poseTable: { value: null },
      pieceTable: { value: null },
      valueTable: { value: null },
      posesARow: { value: 1024 },
      piecesARow: { value: 64 },
      frame: { value: 0 },
      frameRate: { value: 1 },
      selected: { value: -1 },
      colouring: { value: 0 },
      range: { value: new THREE.Vector2(0, 1) },
      ramp: { value: ramp },
      accent: { value: new THREE.Color(0xff7a2f) },
      noise: { value: noiseTexture() },
      lookColour: { value: colours() },
      lookBroken: { value: colours() },
      lookNature: { value: colours() },
    };
    this.solid = pieceMaterial(this.uniforms, false);
    this.clear = pieceMaterial(this.uniforms, true);
    this.shadow = shadowMaterial(this.uniforms);
    this.number = numberMaterial(this.uniforms);
  }

  get drawCalls(): number {
    return this.group.children.length;
  }

  get triangles(): number {
    return (this.shown?.batches ?? []).reduce((sum, batch) => sum + batch.triangles, 0);
  }

  /** Show another recording; shapes that it shares with the last one stay on the graphics card. */
  show(recording: Recording): void {
    const { header } = recording;
    if (
      header.row !== this.uniforms.posesARow.value ||
      header.pieces_a_row !== this.uniforms.piecesARow.value
    ) {
      throw new Error("This recording was made by another version of Brisance.");
    }
    const { poseTable, pieceTable, lookColour, lookBroken, lookNature } = this.uniforms;
    const rows = recording.poses.length / (3 * header.row);
    poseTable.value = dataTexture(poseTable.value, recording.poses, 3 * header.row, rows, wordFormat);
    const tableRows = recording.table.length / (16 * header.pieces_a_row);
    pieceTable.value = dataTexture(
      pieceTable.value,
      recording.table,
      4 * header.pieces_a_row,
      tableRows,
      cellFormat,
    );
    if (this.shown?.batches !== recording.batches) this.build(recording.batches);
    header.looks.slice(0, MOST_LOOKS).forEach((look, index) => {
      lookColour.value[index]?.set(...look.colour, look.opacity);
      lookBroken.value[index]?.set(...look.broken, 1);
      lookNature.value[index]?.set(look.roughness, look.metallic, look.spread, look.name === "wood" ? 1 : 0);
    });
    this.uniforms.frameRate.value = header.frame_rate;
    this.shown = recording;
  }

  /** Colour the pieces by a value of each, NaN where there is none; null for their materials, "speed" for their speed. */
  colour(values: Float32Array | "speed" | null, range: [number, number] = [0, 1]): void {
    const { colouring, valueTable } = this.uniforms;
    colouring.value = values === null ? 0 : values === "speed" ? 2 : 1;
    this.uniforms.range.value.set(...range);
    const width = this.uniforms.piecesARow.value;
    const count = values instanceof Float32Array ? values.length : 0;
    const rows = (this.shown?.table.length ?? 0) / (16 * width);
    const padded = new Float32Array(Math.max(1, Math.ceil(count / width), rows) * width).fill(-1e38);
    if (values instanceof Float32Array)
      padded.set(values.map((value) => (Number.isFinite(value) ? value : -1e38)));
    valueTable.value = dataTexture(valueTable.value, padded, width, padded.length / width, valueFormat);
  }

  /** Number of the piece at a point of the canvas [pixels of the page], or -1. */
  pick(renderer: THREE.WebGLRenderer, camera: THREE.PerspectiveCamera, x: number, y: number): number {
    const size = renderer.getSize(new THREE.Vector2());
    camera.setViewOffset(size.x, size.y, x, y, 1, 1);
    const before = renderer.getClearColor(new THREE.Color());
    const alpha = renderer.getClearAlpha();
    const shadows = renderer.shadowMap.autoUpdate;
    renderer.shadowMap.autoUpdate = false;
    renderer.setRenderTarget(this.pixel);
    renderer.setClearColor(0, 0);
    renderer.clear();
    renderer.render(this.picking, camera);
    const read = new Uint8Array(4);
    renderer.readRenderTargetPixels(this.pixel, 0, 0, 1, 1, read);
    renderer.setRenderTarget(null);
    renderer.setClearColor(before, alpha);
    renderer.shadowMap.autoUpdate = shadows;
    camera.clearViewOffset();
    const [low = 0, middle = 0, high = 0] = read;
    const piece = low + 256 * middle + 65536 * high - 1;
    // Beyond the pieces stand panes that are still whole, of which nothing is told.
    return piece < (this.shown?.pieces ?? 0) ? piece : -1;
  }

  private build(batches: Batch[]): void {
    for (const geometry of this.geometries) geometry.dispose();
    this.group.clear();
    this.picking.clear();
    this.geometries = batches.map(geometryOf);
    batches.forEach((batch, index) => {
      const geometry = this.geometries[index] as THREE.BufferGeometry;
      const mesh = new THREE.Mesh(geometry, batch.transparent ? this.clear : this.solid);
      mesh.customDepthMaterial = this.shadow;
      // Glass throws next to no shadow.
      mesh.castShadow = !batch.transparent;
      mesh.receiveShadow = true;
      // Where a vertex is, only the shader knows.
      mesh.frustumCulled = false;
      mesh.renderOrder = batch.transparent ? 2 : 0;
      this.group.add(mesh);
      const found = new THREE.Mesh(geometry, this.number);
      found.frustumCulled = false;
      this.picking.add(found);
    });
  }
}

function geometryOf(batch: Batch): THREE.BufferGeometry {
  const geometry = batch.instanced ? new THREE.InstancedBufferGeometry() : new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(batch.position, 3));
  const normals = new THREE.InterleavedBuffer(batch.normal, 4);
  geometry.setAttribute("normal", new THREE.InterleavedBufferAttribute(normals, 3, 0, true));
  geometry.setAttribute("broken", new THREE.InterleavedBufferAttribute(normals, 1, 3, true));
  geometry.setIndex(new THREE.BufferAttribute(batch.index, 1));
  if (geometry instanceof THREE.InstancedBufferGeometry) {
    geometry.instanceCount = batch.piece.length;
    geometry.setAttribute("piece", new THREE.InstancedBufferAttribute(batch.piece, 1));
  } else {
    geometry.setAttribute("piece", new THREE.BufferAttribute(batch.piece, 1));
  }
  return geometry;
}

interface Format {
  format: THREE.PixelFormat;
  type: THREE.TextureDataType;
  internal: THREE.PixelFormatGPU;
}

const wordFormat: Format = { format: THREE.RedIntegerFormat, type: THREE.UnsignedIntType, internal: "R32UI" };
const cellFormat: Format = { format: THREE.RGBAFormat, type: THREE.FloatType, internal: "RGBA32F" };
const valueFormat: Format = { format: THREE.RedFormat, type: THREE.FloatType, internal: "R32F" };

/** A texture over numbers as they lie in memory; an old one of the same size takes them up. */
function dataTexture(
  old: THREE.DataTexture | null,
  data: Uint32Array | Float32Array,
  width: number,
  height: number,
  { format, type, internal }: Format,
): THREE.DataTexture {
  if (old && old.image.width === width && old.image.height === height) {
    old.image.data = data;
    old.needsUpdate = true;
    return old;
  }
  old?.dispose();
  const texture = new THREE.DataTexture(data, width, height, format, type);
  texture.internalFormat = internal;
  texture.minFilter = texture.magFilter = THREE.NearestFilter;
  texture.needsUpdate = true;
  return texture;
}
