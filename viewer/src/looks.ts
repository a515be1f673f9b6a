// How materials look: bricks like brick, glass like glass, fracture surfaces unlike the outside.

import * as THREE from "three";
import { PLACED, PLACED_NORMAL, POSE_FUNCTIONS } from "./shaders";

/** Materials a scene can have at most in one recording; more share the last one's look. */
export const MOST_LOOKS = 16;

const TEXELS = 32;

/** What all shaders of the pieces share; see docs/live-view-format.md for the tables. */
export interface Uniforms {
  [name: string]: THREE.IUniform;
  poseTable: THREE.IUniform<THREE.DataTexture | null>;
  pieceTable: THREE.IUniform<THREE.DataTexture | null>;
  /** A value of each piece to colour it by. */
  valueTable: THREE.IUniform<THREE.DataTexture | null>;
  posesARow: THREE.IUniform<number>;
  piecesARow: THREE.IUniform<number>;
  frame: THREE.IUniform<number>;
  frameRate: THREE.IUniform<number>;
  selected: THREE.IUniform<number>;
  /** 0: materials; 1: the value table; 2: speed. */
  colouring: THREE.IUniform<number>;
  range: THREE.IUniform<THREE.Vector2>;
  noise: THREE.IUniform<THREE.Data3DTexture>;
  lookColour: THREE.IUniform<THREE.Vector4[]>;
  lookBroken: THREE.IUniform<THREE.Vector4[]>;
  lookNature: THREE.IUniform<THREE.Vector4[]>;
}

const VERTEX_HEAD = /* glsl */ `
${POSE_FUNCTIONS}
uniform highp sampler2D valueTable;
uniform float selected;
uniform int colouring;
attribute float broken;
varying vec3 vOwn;
varying float vBroken;
varying float vChance;
varying float vValue;
varying float vSelected;
flat varying int vLook;
`;

const VERTEX_BODY = /* glsl */ `
vec3 transformed = turned(pose.turn, pose.size * position) + pose.position;
vOwn = position;
vBroken = broken;
vLook = int(pose.look.z + 0.5);
vChance = pose.look.w;
vSelected = abs(piece - selected) < 0.5 ? 1.0 : 0.0;
int number = int(piece + 0.5);
vValue = colouring == 2 ? pose.speed : texelFetch(valueTable, ivec2(number % PIECES_A_ROW, number / PIECES_A_ROW), 0).x;
`;

const FRAGMENT_HEAD = /* glsl */ `
uniform vec4 lookColour[MOST_LOOKS];
uniform vec4 lookBroken[MOST_LOOKS];
uniform vec4 lookNature[MOST_LOOKS];
uniform highp sampler3D noise;
uniform sampler2D ramp;
uniform vec2 range;
uniform vec3 accent;
uniform int colouring;
varying vec3 vOwn;
varying float vBroken;
varying float vChance;
varying float vValue;
varying float vSelected;
flat varying int vLook;
`;

const COLOUR = /* glsl */ `
vec4 nature = lookNature[vLook];
vec3 own = vOwn * mix(vec3(1.0), vec3(0.12, 1.6, 1.6), nature.w) + vChance * vec3(0.617, 1.733, 3.179);
vec2 grain = texture(noise, own * 6.0).xy;
float patches = smoothstep(0.45, 0.75, texture(noise, own * 1.7 + 0.37).x);
vec3 base = lookColour[vLook].rgb * (1.0 + nature.z * (2.0 * vChance - 1.0));
base = mix(base, base * vec3(0.66, 0.62, 0.60), 0.55 * patches) * (0.80 + 0.40 * grain.y);
vec3 inner = lookBroken[vLook].rgb * (0.70 + 0.60 * grain.y);
diffuseColor.rgb = mix(base, inner, vBroken);
#ifdef CLEAR
  diffuseColor.rgb = mix(lookColour[vLook].rgb, lookBroken[vLook].rgb, vBroken);
#endif
if (colouring > 0) {
  bool known = vValue > -1e30;
  float place = clamp((vValue - range.x) / max(range.y - range.x, 1e-30), 0.0, 1.0);
  diffuseColor.rgb = known ? texture2D(ramp, vec2(place, 0.5)).rgb : vec3(0.18);
}
`;

const GLOW = /* glsl */ `
if (vSelected > 0.5) {
  float edge = pow(1.0 - abs(dot(normalize(vViewPosition), normal)), 2.0);
  totalEmissiveRadiance += accent * (0.22 + 0.6 * edge);
}
`;

/** What shows through glass falls with the angle: clear straight on, a mirror at a grazing angle. */
const CLEARNESS = /* glsl */ `
float facing = abs(dot(normalize(vViewPosition), normal));
float fresnel = 0.04 + 0.96 * pow(1.0 - facing, 5.0);
float body = mix(0.13, 0.55, vBroken);
diffuseColor.a = colouring > 0 ? 0.75 : clamp(body + fresnel, 0.0, 0.95);
`;

/** Clear glass scatters next to nothing; one sees what it mirrors, and its green body at the broken edges. */
const CLEAR_OUTPUT = /* glsl */ `
float scattered = colouring > 0 ? 1.0 : mix(0.32, 0.75, vBroken);
outgoingLight = scattered * totalDiffuse + 2.5 * totalSpecular + totalEmissiveRadiance;
gl_FragColor = vec4(outgoingLight, diffuseColor.a);
`;

/** The material of opaque or of clear pieces, drawn wherever the uniforms' tables say that they are. */
export function pieceMaterial(uniforms: Uniforms, clear: boolean): THREE.MeshStandardMaterial {
  const material = new THREE.MeshStandardMaterial({
    transparent: clear,
    depthWrite: !clear,
    side: clear ? THREE.DoubleSide : THREE.FrontSide,
  });
  material.defines = { ...material.defines, MOST_LOOKS, ...(clear ? { CLEAR: 1 } : {}) };
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", `#include <common>\n${sized(VERTEX_HEAD, uniforms)}`)
      .replace("#include <beginnormal_vertex>", PLACED_NORMAL)
      .replace("#include <begin_vertex>", sized(VERTEX_BODY, uniforms));
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", `#include <common>\n${FRAGMENT_HEAD}`)
      .replace("#include <color_fragment>", COLOUR)
      .replace(
        "#include <roughnessmap_fragment>",
        clear
          ? "float roughnessFactor = 0.14;"
          : "float roughnessFactor = colouring > 0 ? 0.8 : mix(nature.x, 0.5 + 0.5 * nature.x, vBroken);",
      )
      .replace("#include <metalnessmap_fragment>", "float metalnessFactor = colouring > 0 ? 0.0 : nature.y;")
      .replace("#include <emissivemap_fragment>", `${GLOW}\n${clear ? CLEARNESS : ""}`)
      .replace("#include <opaque_fragment>", clear ? CLEAR_OUTPUT : "#include <opaque_fragment>");
  };
  material.customProgramCacheKey = () => `pieces ${clear}`;
  return material;
}

/** The depth of pieces as a light sees them, for their shadows. */
export function shadowMaterial(uniforms: Uniforms): THREE.MeshDepthMaterial {
  const material = new THREE.MeshDepthMaterial();
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", `#include <common>\n${sized(POSE_FUNCTIONS, uniforms)}`)
      .replace("#include <begin_vertex>", PLACED);
  };
  material.customProgramCacheKey = () => "pieces' shadow";
  return material;
}

/** The number of each piece as a colour, to find the one under the pointer. */
export function numberMaterial(uniforms: Uniforms): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    uniforms,
    side: THREE.DoubleSide,
    vertexShader: `${sized(POSE_FUNCTIONS, uniforms)}
      flat varying int vNumber;
      void main() {
        ${PLACED}
        vNumber = int(piece + 0.5) + 1;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(transformed, 1.0);
      }`,
    fragmentShader: `flat varying int vNumber;
      void main() {
        gl_FragColor = vec4(vec3(vNumber & 255, (vNumber >> 8) & 255, (vNumber >> 16) & 255) / 255.0, 1.0);
      }`,
    blending: THREE.NoBlending,
  });
}

/** The tables' widths are constants of the format, so they are written into the shader. */
export function sized(text: string, uniforms: Uniforms): string {
  return text
    .replaceAll("POSES_A_ROW", `${uniforms.posesARow.value}`)
    .replaceAll("PIECES_A_ROW", `${uniforms.piecesARow.value}`);
}

/** A tile of two noises in space: patches in red, grain in green. */
export function noiseTexture(): THREE.Data3DTexture {
  const data = new Uint8Array(2 * TEXELS ** 3);
  const coarse = lattice(4);
  const middle = lattice(8);
  const fine = lattice(32);
  for (let z = 0, at = 0; z < TEXELS; z++) {
    for (let y = 0; y < TEXELS; y++) {
      for (let x = 0; x < TEXELS; x++, at += 2) {
        data[at] = 255 * (0.62 * coarse(x, y, z) + 0.38 * middle(x, y, z));
        data[at + 1] = 255 * (0.55 * fine(x, y, z) + 0.45 * middle(x, y, z));
      }
    }
  }
  const texture = new THREE.Data3DTexture(data, TEXELS, TEXELS, TEXELS);
  texture.format = THREE.RGFormat;
  texture.wrapS = texture.wrapT = texture.wrapR = THREE.RepeatWrapping;
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.unpackAlignment = 1;
  texture.needsUpdate = true;
  return texture;
}

/** Value noise on a lattice of `cells` a side that repeats. */
function lattice(cells: number): (x: number, y: number, z: number) => number {
  const value = (x: number, y: number, z: number) => {
    let key = (x % cells) + cells * ((y % cells) + cells * (z % cells)) + 1013 * cells;
    key = Math.imul(key ^ (key >>> 16), 0x45d9f3b);
    key = Math.imul(key ^ (key >>> 16), 0x45d9f3b);
    return ((key ^ (key >>> 16)) >>> 0) / 2 ** 32;
  };
  const ease = (t: number) => t * t * (3 - 2 * t);
  return (x, y, z) => {
    const at = [x, y, z].map((place) => (place * cells) / TEXELS) as [number, number, number];
    const [i, j, k] = at.map(Math.floor) as [number, number, number];
    const [u, v, w] = at.map((place) => ease(place - Math.floor(place))) as [number, number, number];
    let sum = 0;
    for (let corner = 0; corner < 8; corner++) {
      const [a, b, c] = [corner & 1, (corner >> 1) & 1, corner >> 2];
      const weight = (a ? u : 1 - u) * (b ? v : 1 - v) * (c ? w : 1 - w);
      sum += weight * value(i + a, j + b, k + c);
    }
    return sum;
  };
}
