// What stands around the pieces: sky, sun, and a ground with a grid of metres.

import * as THREE from "three";

export type Theme = "dark" | "light";

interface Daylight {
  zenith: number;
  horizon: number;
  nadir: number;
  sun: number;
  sunlight: number;
  skylight: number;
  reflected: number;
  earth: number;
  line: number;
  exposure: number;
}

/** A clear day, and the last light after one. */
const DAYLIGHT: Record<Theme, Daylight> = {
  light: {
    zenith: 0x4d7fc4,
    horizon: 0xdfe3e6,
    nadir: 0x8d8273,
    sun: 0xfff0d8,
    sunlight: 3.2,
    skylight: 1.1,
    reflected: 0.35,
    earth: 0xa39580,
    line: 0x4a4236,
    exposure: 0.95,
  },
  dark: {
    zenith: 0x10182a,
    horizon: 0x59636f,
    nadir: 0x1c1d20,
    sun: 0xffe9d6,
    sunlight: 2.6,
    skylight: 3.2,
    reflected: 1.7,
    earth: 0x5d646c,
    line: 0xb4c2d6,
    exposure: 1.35,
  },
};

const GROUND_VERTEX_HEAD = "varying vec3 vPlace;";
const GROUND_FRAGMENT_HEAD = /* glsl */ `
varying vec3 vPlace;
uniform vec3 haze;
uniform vec3 line;
uniform float reach;
uniform highp sampler3D noise;
float lines(vec2 place, float step, float width) {
  vec2 cell = place / step;
  vec2 apart = abs(fract(cell - 0.5) - 0.5) / max(fwidth(cell), 1e-6);
  float fade = 1.0 - smoothstep(0.15, 0.5, max(fwidth(cell).x, fwidth(cell).y));
  return (1.0 - min(min(apart.x, apart.y) / width, 1.0)) * fade;
}
`;
const GROUND_COLOUR = /* glsl */ `
float patches = texture(noise, vec3(vPlace.xz / 9.0, 0.1)).x;
float grain = texture(noise, vec3(vPlace.xz / 1.3, 0.7)).y;
diffuseColor.rgb *= (0.80 + 0.34 * patches) * (0.90 + 0.20 * grain);
float drawn = max(0.14 * lines(vPlace.xz, 1.0, 1.2), 0.26 * lines(vPlace.xz, 10.0, 1.6));
diffuseColor.rgb = mix(diffuseColor.rgb, line, drawn);
`;
const GROUND_HAZE = /* glsl */ `
float gone = smoothstep(reach, 14.0 * reach, length(vPlace - cameraPosition));
gl_FragColor.rgb = mix(gl_FragColor.rgb, haze, gone);
`;

export class Surroundings {
  readonly group = new THREE.Group();
  private readonly sun = new THREE.DirectionalLight();
  private readonly sky = new THREE.HemisphereLight();
  private readonly ground: THREE.Mesh<THREE.PlaneGeometry, THREE.MeshLambertMaterial>;
  private readonly haze = { value: new THREE.Color() };
  private readonly line = { value: new THREE.Color() };
  private readonly reach = { value: 10 };
  private direction = new THREE.Vector3(-0.5, 0.7, 0.5).normalize();
  private radius = 0;
  private environment: THREE.Texture | undefined;

  constructor(
    private readonly scene: THREE.Scene,
    private readonly renderer: THREE.WebGLRenderer,
    noise: THREE.Texture,
  ) {
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.bias = -0.0004;
    this.sun.shadow.normalBias = 0.01;
    const earth = new THREE.MeshLambertMaterial();
    earth.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, {
        haze: this.haze,
        line: this.line,
        reach: this.reach,
        noise: { value: noise },
      });
      shader.vertexShader = shader.vertexShader
        .replace("#include <common>", `#include <common>\n${GROUND_VERTEX_HEAD}`)
        .replace(
          "#include <begin_vertex>",
          "#include <begin_vertex>\nvPlace = (modelMatrix * vec4(position, 1.0)).xyz;",
        );
      shader.fragmentShader = shader.fragmentShader
        .replace("#include <common>", `#include <common>\n${GROUND_FRAGMENT_HEAD}`)
        .replace("#include <color_fragment>", GROUND_COLOUR)
        .replace("#include <opaque_fragment>", `#include <opaque_fragment>\n${GROUND_HAZE}`);
    };
    this.ground = new THREE.Mesh(new THREE.PlaneGeometry(2, 2).rotateX(-Math.PI / 2), earth);
    this.ground.scale.setScalar(4000);
    this.ground.receiveShadow = true;
    this.group.add(this.sky, this.sun, this.sun.target, this.ground);
    scene.add(this.group);
  }

  /** Put the ground at a height [m], or nowhere. */
  setGround(height: number | null): void {
    this.ground.visible = height !== null;
    this.ground.position.y = height ?? 0;
  }

  /** Let the sun stand across the way the blast goes, which is horizontal. */
  setBlastDirection(along: THREE.Vector3): void {
    const side = new THREE.Vector3(-along.z, 0, along.x);
    this.direction = side.multiplyScalar(0.45).addScaledVector(along, 0.75).setY(0.9).normalize();
    this.radius = 0;
  }

  /** Let shadows be sharp within a sphere, and the ground fade beyond it. */
  follow(centre: THREE.Vector3, radius: number): void {
    // The sphere grows in steps, and its centre moves in steps: shadows then do not crawl.
    const stepped = 1.3 ** Math.ceil(Math.log(Math.max(radius, 0.5)) / Math.log(1.3));
    const grid = stepped / 4;
    const at = centre.clone().divideScalar(grid).round().multiplyScalar(grid);
    if (stepped === this.radius && at.equals(this.sun.target.position)) return;
    this.radius = stepped;
    this.reach.value = Math.max(10, 2 * stepped);
    this.sun.target.position.copy(at);
    this.sun.position.copy(at).addScaledVector(this.direction, 4 * stepped);
    const camera = this.sun.shadow.camera;
    camera.left = camera.bottom = -1.3 * stepped;
    camera.right = camera.top = 1.3 * stepped;
    camera.near = 0.5 * stepped;
    camera.far = 12 * stepped;
    camera.updateProjectionMatrix();
    this.sun.target.updateMatrixWorld();
  }

  setTheme(theme: Theme): void {
    const day = DAYLIGHT[theme];
    this.renderer.toneMappingExposure = day.exposure;
    this.sun.color.set(day.sun);
    this.sun.intensity = day.sunlight;
    this.sky.color.set(day.horizon).lerp(new THREE.Color(day.zenith), 0.35);
    this.sky.groundColor.set(day.earth);
    this.sky.intensity = day.skylight;
    this.ground.material.color.set(day.earth);
    this.haze.value.set(day.horizon);
    this.line.value.set(day.line);
    const sky = skyTexture(day);
    const baker = new THREE.PMREMGenerator(this.renderer);
    this.environment?.dispose();
    this.environment = baker.fromEquirectangular(sky).texture;
    baker.dispose();
    (this.scene.background as THREE.Texture | null)?.dispose();
    this.scene.background = sky;
    this.scene.environment = this.environment;
    this.scene.environmentIntensity = day.reflected;
  }
}

/** The sky from straight down to straight up, as a panorama. */
function skyTexture(day: Daylight): THREE.DataTexture {
  // Reflections are baked from it at a quarter of its width a side.
  const width = 512;
  const height = 256;
  const data = new Uint16Array(4 * width * height);
  const colour = new THREE.Color();
  for (let row = 0; row < height; row++) {
    const up = (row / (height - 1)) * 2 - 1;
    colour.set(day.horizon);
    if (up > 0) colour.lerp(new THREE.Color(day.zenith), Math.min(1, up * 2.2) ** 0.6);
    else colour.lerp(new THREE.Color(day.nadir), Math.min(1, -up * 8));
    const texel = [colour.r, colour.g, colour.b, 1].map(THREE.DataUtils.toHalfFloat);
    for (let column = 0; column < width; column++) data.set(texel, 4 * (row * width + column));
  }
  const texture = new THREE.DataTexture(data, width, height, THREE.RGBAFormat, THREE.HalfFloatType);
  texture.mapping = THREE.EquirectangularReflectionMapping;
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
