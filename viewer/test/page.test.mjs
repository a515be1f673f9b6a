// The page around the live view: how it fits, what it exports, what becomes of its server, how fast it is.

import assert from "node:assert/strict";
import { rm } from "node:fs/promises";
import { join } from "node:path";
import { describe, test } from "node:test";
import {
  answer,
  difference,
  drawn,
  launchKillable,
  OUT,
  open,
  picture,
  python,
  SMALL,
  screenshot,
  serve,
  showFrame,
} from "./harness.mjs";
import { SIZE, studio } from "./studio.mjs";

const EXPORT = `
import json, sys
from brisance.__main__ import main
sys.argv = ["brisance", "run", "scenes/crates.toml", "-o", sys.argv[1], "--quiet"]
print(json.dumps(main()))
`;

const here = studio();
const { fresh } = here;

describe("the page", () => {
  test("names every control", async () => {
    const page = await fresh();
    for (const part of await page.locator(".side details").all())
      await part.evaluate((one) => {
        one.open = true;
      });
    const nameless = await page.evaluate(() =>
      [...document.querySelectorAll("input, select, button, summary, canvas[tabindex]")]
        .filter((one) => {
          const label = one.getAttribute("aria-label") || one.labels?.[0]?.textContent || one.textContent;
          return !label?.trim();
        })
        .map((one) => one.outerHTML.slice(0, 100)),
    );
    assert.deepEqual(nameless, []);
    const undescribed = await page.evaluate(() =>
      [...document.querySelectorAll(".field :is(input, select)")]
        .filter((one) => !document.getElementById(one.getAttribute("aria-describedby"))?.textContent)
        .map((one) => one.outerHTML.slice(0, 100)),
    );
    assert.deepEqual(undescribed, []);
  });

  for (const [name, width, height, colorScheme] of [
    ["desktop-dark", 1280, 800, "dark"],
    ["desktop-light", 1280, 800, "light"],
    ["narrow-light", 800, 560, "light"],
    ["phone-dark", 390, 780, "dark"],
    ["phone-light", 390, 780, "light"],
  ]) {
    test(`fits and can be read: ${name}`, async () => {
      const page = await fresh();
      await page.setViewportSize({ width, height });
      await page.emulateMedia({ colorScheme });
      await showFrame(page, width > 400 ? 2.4 : 24);
      assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), colorScheme);
      const widest = await page.evaluate(() =>
        Math.max(
          ...["html", "body", "#app", ".foot"].map((part) => document.querySelector(part).scrollWidth),
        ),
      );
      assert.ok(widest <= width, `${widest} pixels in ${width}`);
      const [ink, ground] = await page.evaluate(() => {
        const style = getComputedStyle(document.documentElement);
        return ["--soft", "--panel"].map((name_) => style.getPropertyValue(name_).trim());
      });
      assert.ok(contrast(ink, ground) > 4.5, `${ink} on ${ground}`);
      await screenshot(page, `${name}`);
      if (width < 400) {
        await page.getByRole("button", { name: "Controls" }).click();
        await page.getByLabel("Mass", { exact: true }).first().waitFor();
        await drawn(page);
        await screenshot(page, `${name}-controls`);
        await page.getByRole("button", { name: "Controls" }).click();
      }
      await page.setViewportSize(SIZE);
    });
  }
});

describe("the exported page", () => {
  const file = join(OUT, "crates.html");

  test("opens from disk and plays, without a server or a network", async () => {
    await rm(file, { force: true });
    assert.equal(await python(EXPORT, file), 0);
    const page = await open(here.browser, `file://${file}`, { colorScheme: "light" });
    await page.keyboard.press(" ");
    await page.waitForFunction(() => window.brisance.viewer.timeline.time > 0);
    await showFrame(page, 30);
    const shown = await picture(page);
    assert.ok(new Set(shown).size > 200);
    await showFrame(page, 0);
    assert.ok(difference(shown, await picture(page)) > 0.005);
    assert.deepEqual(page.problems, []);
    assert.deepEqual(
      page.requests.filter((url) => !/^(file|data|blob):/.test(url)),
      [],
    );
    assert.equal(await page.getByLabel("Controls").count(), 0);
    const gizmo = await page.evaluate(() => window.brisance.viewer.stage.charges.gizmo.getHelper().visible);
    assert.equal(gizmo, false, "there is nothing to drag");
    await screenshot(page, "exported");
    await page.close();
  });
});

describe("the server", () => {
  test("is free again when the browser is killed in the middle of a run", async () => {
    const killable = await launchKillable();
    const page = await open(killable.browser, here.server.address, SMALL);
    const running = async () => (await (await fetch(`${here.server.address}api/status`)).json()).running;
    await page.evaluate(() => {
      const { live } = window.brisance;
      live.scene.time = { duration: 10, frame_rate: 1, step: 1e-8 };
      live.ask(true);
    });
    await page.locator("progress").waitFor({ state: "visible" });
    assert.ok((await running()) > 0);
    await killable.server.kill();
    const deadline = Date.now() + 10_000;
    while ((await running()) > 0) assert.ok(Date.now() < deadline, "the run goes on");
  });

  test("is asked again by a page that lost it", async () => {
    const own = await serve("scenes/slow_motion.toml");
    const page = await open(here.browser, own.address, SMALL);
    own.stop();
    await page.waitForFunction(() => document.querySelector(".status").textContent.startsWith("Waiting"));
    await page.close();
  });
});

describe("the speed", () => {
  // The goals are 100 and 300 ms; a machine that draws in software beside other work is given ten times as much.
  test("of turning a knob of the wall, reported", async (context) => {
    const page = await fresh();
    await showFrame(page, 10);
    await report(context, page, () => undefined, { rounds: 12, most: 1000 });
  });

  test("of turning a knob of a window in a thousand pieces, reported", async (context) => {
    const own = await serve("scenes/window.toml");
    const page = await open(here.browser, own.address, SMALL);
    const shatter = () => {
      window.brisance.live.scene.window[0].pattern = { pieces: 1000 };
    };
    await report(context, page, shatter, { rounds: 6, most: 3000 });
    await page.close();
    own.stop();
  });
});

/** Turns the charge's mass a few times and tells how long it is until the new picture. */
async function report(context, page, prepare, { rounds, most }) {
  await page.evaluate(prepare);
  const answers = [];
  for (let round = 0; round < rounds; round++) {
    answers.push(
      await answer(page, () =>
        page.evaluate((more) => {
          window.brisance.live.scene.charge[0].mass += more;
          window.brisance.live.ask(true);
        }, round + 1),
      ),
    );
  }
  const sorted = (key) => answers.map((round) => round[key]).sort((a, b) => a - b);
  for (const key of ["simulated", "answer", "decoded", "total"]) {
    const [times, middle] = [sorted(key), Math.floor(rounds / 2)];
    context.diagnostic(`${key}: best ${times[0].toFixed(1)} ms, median ${times[middle].toFixed(1)} ms`);
  }
  context.diagnostic(`message ${answers[0].bytes} bytes`);
  assert.ok(sorted("total")[0] < most);
}

function contrast(first, second) {
  const light = (text) => {
    const parts = [1, 3, 5].map((at) => Number.parseInt(text.slice(at, at + 2), 16) / 255);
    const [red, green, blue] = parts.map((value) =>
      value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4,
    );
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
  };
  const [low, high] = [light(first), light(second)].sort((a, b) => a - b);
  return (high + 0.05) / (low + 0.05);
}
