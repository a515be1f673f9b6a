// Where the graphics card puts the pieces, read back from it: for tests, which compare it with the report.

import * as THREE from "three";
import { sized, type Uniforms } from "./looks";
import { PLACED, POSE_FUNCTIONS } from "./shaders";

const WIDTH = 256;

/** Places [m], x y z of each piece, computed by the vertex shader at the frame now shown. */
export function placesOnCard(renderer: THREE.WebGLRenderer, uniforms: Uniforms, count: number): Float32Array {
  const height = Math.ceil(count / WIDTH);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
  geometry.setAttribute(
    "piece",
    new THREE.BufferAttribute(
      Float32Array.from({ length: count }, (_, i) => i),
      1,
    ),
  );
  const material = new THREE.ShaderMaterial({
    uniforms,
    vertexShader: `${sized(POSE_FUNCTIONS, uniforms)}
      varying vec3 vPlace;
      void main() {
        ${PLACED}
        vPlace = transformed;
        int number = int(piece + 0.5);
        vec2 pixel = vec2(number % ${WIDTH}, number / ${WIDTH}) + 0.5;
        gl_Position = vec4(pixel / vec2(${WIDTH}, ${height}) * 2.0 - 1.0, 0.0, 1.0);
        gl_PointSize = 1.0;
      }`,
    fragmentShader: "varying vec3 vPlace; void main() { gl_FragColor = vec4(vPlace, 1.0); }",
    depthTest: false,
    blending: THREE.NoBlending,
  });
  const points = new THREE.Points(geometry, material);
  points.frustumCulled = false;
  const target = new THREE.WebGLRenderTarget(WIDTH, height, { type: THREE.FloatType });
  const read = new Float32Array(4 * WIDTH * height);
  renderer.setRenderTarget(target);
  renderer.render(points, new THREE.Camera());
  renderer.readRenderTargetPixels(target, 0, 0, WIDTH, height, read);
  renderer.setRenderTarget(null);
  for (const part of [geometry, material, target]) part.dispose();
  return Float32Array.from({ length: 3 * count }, (_, i) => read[4 * Math.floor(i / 3) + (i % 3)] ?? 0);
}
