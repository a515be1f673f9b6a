// Pictures a second of exported pages, and what is drawn for each: called by benches/live_view.py.

import { launch, open } from "./harness.mjs";

const pages = JSON.parse(process.argv[2]);
const SECONDS = 4;

const browser = await launch();
console.log(
  ["", "draw calls", "triangles", "in all calls", "decode ms", "fine ms", "pictures/s"]
    .map((text, index) => (index ? text.padStart(13) : text.padEnd(16)))
    .join(""),
);
for (const { name, file } of pages) {
  const page = await open(browser, `file://${file}`);
  const found = await page.evaluate(async (seconds) => {
    const { viewer } = window.brisance;
    const { stage, timeline, recording } = viewer;
    const gl = stage.renderer.getContext();
    const pixel = new Uint8Array(4);
    // One picture in full resolution: reading a pixel waits until it is drawn.
    let fine = Number.POSITIVE_INFINITY;
    for (let round = 0; round < 3; round++) {
      const started = performance.now();
      stage.render(1);
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      fine = Math.min(fine, performance.now() - started);
    }
    const started = performance.now();
    new recording.constructor(recording.poses.buffer);
    const decode = performance.now() - started;
    timeline.play();
    let pictures = 0;
    stage.afterDrawing = () => {
      pictures += 1;
    };
    await new Promise((done) => setTimeout(done, 1000 * seconds));
    timeline.pause();
    return { ...stage.info, decode, fine, rate: pictures / seconds };
  }, SECONDS);
  console.log(
    [
      found.drawCalls,
      found.triangles,
      found.renderCalls,
      found.decode.toFixed(2),
      found.fine.toFixed(0),
      found.rate.toFixed(1),
    ].reduce((line, value) => line + String(value).padStart(13), name.padEnd(16)),
  );
  await page.close();
}
await browser.close();
