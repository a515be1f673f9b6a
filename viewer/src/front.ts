// The shock front at the current time: a faint shell, brightest at its edge and where it runs along the ground.

import * as THREE from "three";
import type { Recording } from "./recording";

const VERTEX = /* glsl */ `
varying vec3 vNormal;
varying vec3 vPlace;
void main() {
  vNormal = normalize(mat3(modelMatrix) * normal);
  vec4 place = modelMatrix * vec4(position, 1.0);
  vPlace = place.xyz;
  gl_Position = projectionMatrix * viewMatrix * place;
}`;

const FRAGMENT = /* glsl */ `
varying vec3 vNormal;
varying vec3 vPlace;
uniform vec3 colour;
uniform float strength;
uniform float ground;
uniform float radius;
void main() {
  if (vPlace.y < ground) discard;
  float facing = abs(dot(normalize(cameraPosition - vPlace), normalize(vNormal)));
  float rim = pow(1.0 - facing, 3.5);
  float foot = 1.0 - smoothstep(0.0, 0.03 + 0.012 * radius, vPlace.y - ground);
  gl_FragColor = vec4(colour, strength * (0.05 + 0.55 * rim + 0.6 * foot));
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
}`;

export class Fronts {
  readonly group = new THREE.Group();
  private readonly colour = { value: new THREE.Color(0xffc48a) };
  private readonly ground = { value: -1e30 };
  private readonly shape = new THREE.SphereGeometry(1, 96, 64);
  private recording: Recording | undefined;

  show(recording: Recording): void {
    this.recording = recording;
    this.ground.value = recording.header.ground_m ?? -1e30;
    while (this.group.children.length > recording.header.charges.length) {
      const last = this.group.children.at(-1) as THREE.Mesh<THREE.BufferGeometry, THREE.Material>;
      last.material.dispose();
      this.group.remove(last);
    }
    while (this.group.children.length < recording.header.charges.length) this.group.add(this.shell());
    recording.header.charges.forEach((charge, index) => {
      this.group.children[index]?.position.set(...charge.position_m);
    });
  }

  setTheme(dark: boolean): void {
    this.colour.value.set(dark ? 0xffc48a : 0xfff6e8);
  }

  setTime(time: number): void {
    this.group.children.forEach((shell, index) => {
      const radius = this.recording?.frontRadius(index, time) ?? 0;
      shell.visible = radius > 1e-3;
      shell.scale.setScalar(Math.max(radius, 1e-3));
      const { uniforms } = (shell as THREE.Mesh<THREE.BufferGeometry, THREE.ShaderMaterial>).material;
      if (uniforms.radius) uniforms.radius.value = radius;
      // It fades as the wave weakens: with the distance in cube roots of the charge's mass.
      const scaled = radius / Math.cbrt(this.recording?.header.charges[index]?.tnt_mass_kg || 1);
      const strength = 1 - THREE.MathUtils.smoothstep(scaled, 4, 24);
      shell.visible &&= strength > 0;
      if (uniforms.strength) uniforms.strength.value = strength;
    });
  }

  private shell(): THREE.Mesh {
    const material = new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { colour: this.colour, ground: this.ground, radius: { value: 0 }, strength: { value: 1 } },
      transparent: true,
      depthWrite: false,
      side: THREE.DoubleSide,
    });
    const shell = new THREE.Mesh(this.shape, material);
    shell.renderOrder = 3;
    shell.frustumCulled = false;
    return shell;
  }
}
