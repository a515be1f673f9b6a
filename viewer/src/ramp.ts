// The colours of values: dark violet over red to pale yellow, equally stepped in lightness, so that it also reads in grey.

import * as THREE from "three";

const STOPS = ["#1b1044", "#51127c", "#8f2a81", "#c63c74", "#ee5b5e", "#fb8d60", "#fec287", "#fcfdbf"];

/** The ramp as a texture, low values left. */
export function rampTexture(): THREE.DataTexture {
  const width = 256;
  const data = new Uint8Array(4 * width);
  const colour = new THREE.Color();
  const next = new THREE.Color();
  for (let i = 0; i < width; i++) {
    const place = (i / (width - 1)) * (STOPS.length - 1);
    const stop = Math.min(Math.floor(place), STOPS.length - 2);
    colour.set(STOPS[stop] as string).lerp(next.set(STOPS[stop + 1] as string), place - stop);
    // The numbers of a linear texture: the shader works in linear light.
    data.set([255 * colour.r, 255 * colour.g, 255 * colour.b, 255], 4 * i);
  }
  const texture = new THREE.DataTexture(data, width, 1);
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** The ramp for the page, low values left. */
export const RAMP_CSS = `linear-gradient(to right, ${STOPS.join(", ")})`;
