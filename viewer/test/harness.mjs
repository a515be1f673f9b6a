// A server, a browser, and pages that remember what went wrong on them.

import { spawn } from "node:child_process";
import { existsSync, mkdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

export const ROOT = join(dirname(fileURLToPath(import.meta.url)), "..", "..");
export const OUT = join(ROOT, "out", "view");
export const PYTHON = process.env.PYTHON ?? join(ROOT, ".venv", "bin", "python");

const CHROMIUM = process.env.CHROMIUM ?? "/usr/bin/chromium";
/** No display, no graphics card, no questions asked, no calls home. */
const FLAGS = [
  "--no-sandbox",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
];

/** Pictures are drawn in software here, so a page that nobody looks at is small. */
export const SMALL = { viewport: { width: 320, height: 240 } };

mkdirSync(OUT, { recursive: true });

function options() {
  if (!existsSync(CHROMIUM)) {
    throw new Error(`${CHROMIUM} does not exist; install Chromium (make chromium) or name it in CHROMIUM.`);
  }
  return { executablePath: CHROMIUM, headless: true, args: FLAGS };
}

export const launch = () => chromium.launch(options());

/** A browser whose process can be killed. */
export async function launchKillable() {
  const server = await chromium.launchServer(options());
  return { server, browser: await chromium.connect(server.wsEndpoint()) };
}

/** `brisance view` on a scene; its address, and a way to end it. */
export async function serve(scene) {
  const process_ = spawn(PYTHON, ["-m", "brisance", "view", scene, "--no-open", "--port", "0"], {
    cwd: ROOT,
    stdio: ["ignore", "pipe", "inherit"],
  });
  for await (const line of createInterface({ input: process_.stdout })) {
    return { address: line.trim(), stop: () => process_.kill("SIGKILL") };
  }
  throw new Error("brisance view ended without an address");
}

/** Run Python and return what it prints, as JSON. */
export async function python(code, ...parameters) {
  const process_ = spawn(PYTHON, ["-c", code, ...parameters], {
    cwd: ROOT,
    stdio: ["ignore", "pipe", "inherit"],
  });
  let text = "";
  for await (const part of process_.stdout) text += part;
  return JSON.parse(text);
}

/** A page on which a recording is shown, at rest at its beginning; `problems` collects
 * what the console says, `requests` what was asked for. */
export async function open(browser, address, more = {}) {
  const page = await browser.newPage({
    viewport: { width: 1280, height: 800 },
    colorScheme: "dark",
    reducedMotion: "reduce",
    ...more,
  });
  page.problems = [];
  page.requests = [];
  page.on("request", (request) => page.requests.push(request.url()));
  page.on("pageerror", (error) => page.problems.push(error.message));
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) page.problems.push(message.text());
  });
  await page.goto(address);
  await page.waitForFunction(() => window.brisance?.viewer?.recording);
  await drawn(page);
  return page;
}

/** Pause at a frame and wait until it is drawn. */
export async function showFrame(page, frame) {
  await page.evaluate((place) => {
    const { timeline, recording } = window.brisance.viewer;
    timeline.pause();
    timeline.seek(place / recording.header.frame_rate);
  }, frame);
  await drawn(page);
}

/** Wait for two pictures, so that whatever has changed is on screen. */
export const drawn = (page) =>
  page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done()))),
  );

/** A picture of the whole page in full resolution, kept for whoever wants to look. */
export async function screenshot(page, name) {
  await drawn(page);
  await page.waitForFunction(() => window.brisance.viewer.stage.isFine);
  await drawn(page);
  await page.screenshot({ path: join(OUT, `${name}.png`) });
}

/** Wait for an answer of the server that comes after `act`; its timing. */
export async function answer(page, act) {
  const before = await page.evaluate(() => window.brisance.live.timings.length);
  await act();
  await page.waitForFunction((count) => window.brisance.live.timings.length > count, before);
  return page.evaluate(() => window.brisance.live.timings.at(-1));
}

/** The picture of the canvas alone, without what lies over it: width, height and colours, a number each. */
export const picture = (page) =>
  page.evaluate(async () => {
    const blob = await window.brisance.viewer.stage.png();
    const image = await createImageBitmap(blob);
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    return Array.from(new Uint32Array(data.buffer).filter((_, index) => index % 7 === 0));
  });

/** Share of the picture's points that differ. */
export function difference(first, second) {
  return first.filter((colour, index) => colour !== second[index]).length / first.length;
}
