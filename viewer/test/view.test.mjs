// The live view in a browser: everything an artist does, done by a machine.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { describe, test } from "node:test";
import {
  answer,
  difference,
  drawn,
  open,
  picture,
  python,
  SMALL,
  screenshot,
  showFrame,
} from "./harness.mjs";
import { SIZE, studio } from "./studio.mjs";

const POSITIONS = `
import json, sys
import brisance as br
scene = br.load("scenes/brick_wall.toml", sys.argv[1:])
result = br.simulate(scene)
frames = {f: result.positions[f].astype(float).ravel().tolist() for f in (0, 3, 17, 40)}
final = [x for body in result.report()["bodies"] for x in body["final_position_m"]]
print(json.dumps({"frames": frames, "final": final, "facts": result.report()["bodies"]}))
`;

const here = studio();
const { fresh, scene, state } = here;

describe("the picture", () => {
  test("is there, without a word in the console, and changes from frame to frame", async () => {
    const page = await fresh();
    await showFrame(page, 0);
    const first = await picture(page);
    assert.ok(new Set(first).size > 200, "the canvas is not blank");
    await showFrame(page, 20);
    const later = await picture(page);
    assert.ok(difference(first, later) > 0.02, "frame 20 differs from frame 0");
    await showFrame(page, 0);
    assert.equal(difference(first, await picture(page)), 0, "the same frame is the same picture");
    assert.deepEqual(page.problems, []);
    const { drawCalls, triangles } = await page.evaluate(() => window.brisance.viewer.stage.info);
    assert.equal(drawCalls, 2);
    assert.equal(triangles, 27 * 44);
  });

  test("shows the pieces where the recording has them, to a millimetre, on the graphics card", async () => {
    const truth = await python(POSITIONS);
    const page = await fresh();
    for (const [frame, expected] of [...Object.entries(truth.frames), [40, truth.final]]) {
      await showFrame(page, Number(frame));
      const [card, processor] = await page.evaluate((number) => {
        const { viewer, poseAt } = window.brisance;
        const poses = viewer.recording.header.names.map(
          (_, piece) => poseAt(viewer.recording, piece, number).position,
        );
        return [Array.from(viewer.stage.placesOnCard()), poses.flat()];
      }, Number(frame));
      assert.equal(card.length, expected.length);
      expected.forEach((value, index) => {
        assert.ok(Math.abs(card[index] - value) < 1e-3, `card, frame ${frame}: ${card[index]} for ${value}`);
        assert.ok(
          Math.abs(processor[index] - value) < 1e-3,
          `frame ${frame}: ${processor[index]} for ${value}`,
        );
      });
    }
  });

  test("between frames, goes straight from one to the next, from the arrival on", async () => {
    const page = await fresh();
    const { arrival, places } = await page.evaluate(() => {
      const { viewer, poseAt } = window.brisance;
      const { recording } = viewer;
      const arrivalFrame = recording.fact("arrival_time_s", 0) * recording.header.frame_rate;
      const at = (frame) => poseAt(recording, 0, frame).position[2];
      const before = Math.floor(arrivalFrame);
      const middle = (arrivalFrame + before + 1) / 2;
      return {
        arrival: arrivalFrame,
        places: [at(before), at(arrivalFrame), at(middle), at(before + 1), at(20), at(20.25), at(21)],
      };
    });
    assert.ok(arrival > 2 && arrival < 3);
    assert.ok(Math.abs(places[1] - places[0]) < 1e-6, "it rests until the front is there");
    assert.ok(Math.abs(places[2] - (places[0] + places[3]) / 2) < 1e-5);
    assert.ok(Math.abs(places[5] - (0.75 * places[4] + 0.25 * places[6])) < 1e-5);
  });

  test("has colours for values, with a legend that names their range", async () => {
    const page = await fresh();
    await showFrame(page, 25);
    const plain = await picture(page);
    for (const [way, unit] of [
      ["arrival", "ms"],
      ["impulse", "N s"],
      ["attenuation", ""],
      ["speed", "m/s"],
    ]) {
      await page.getByLabel("Colour by").selectOption(way);
      await drawn(page);
      assert.ok(difference(plain, await picture(page)) > 0.01, `${way} changes the picture`);
      assert.ok((await page.locator(".legend").getAttribute("aria-label")).endsWith(unit));
    }
    const legend = await page.locator(".legend").getAttribute("aria-label");
    assert.match(legend, /^Speed from 0 to [\d.]+ m\/s$/);
    await screenshot(page, "speed");
    await page.getByLabel("Colour by").selectOption("");
    await drawn(page);
    assert.equal(difference(plain, await picture(page)), 0);
  });
});

describe("the controls", () => {
  test("a new mass gives a new result, and the play head stays", async () => {
    const page = await fresh();
    await showFrame(page, 12);
    const before = await state(page);
    await answer(page, async () => {
      await page.getByLabel("Mass", { exact: true }).first().fill("60");
      await page.keyboard.press("Enter");
    });
    const now = await state(page);
    const truth = await python(POSITIONS, "charge.0.mass=60");
    assert.ok(Math.abs(now.launch - truth.facts[0].launch_speed_m_s) < 1e-4);
    assert.ok(now.arrival > before.arrival);
    assert.equal(now.time, before.time);
    assert.equal(now.playing, false);
    assert.deepEqual(page.problems, []);
  });

  test("dragging the charge gives a new result", async () => {
    const page = await fresh();
    await showFrame(page, 10);
    const before = await state(page);
    const place = (await scene(page)).charge[0].position;
    const [x, y] = await page.evaluate((at) => window.brisance.viewer.stage.onPage(at), place);
    await answer(page, async () => {
      await page.mouse.move(x, y);
      await drawn(page);
      await page.mouse.down();
      await page.mouse.move(x - 40, y, { steps: 4 });
      await page.mouse.up();
    });
    await page.waitForFunction(() => !window.brisance.live.connection.isBusy);
    const moved = (await scene(page)).charge[0].position;
    const now = await state(page);
    assert.ok(Math.hypot(...moved.map((value, axis) => value - place[axis])) > 0.3, `moved to ${moved}`);
    assert.ok(moved[1] >= 0, "not below the ground");
    assert.notEqual(now.launch, before.launch);
    assert.equal(now.time, before.time);
    assert.equal(await page.getByLabel("Position x").first().inputValue(), String(moved[0]));
    const truth = await python(POSITIONS, `charge.0.position=${JSON.stringify(moved)}`);
    assert.ok(Math.abs(now.launch - truth.facts[0].launch_speed_m_s) < 1e-4);
    assert.deepEqual(page.problems, []);
  });

  test("a bad value shows the sentence and keeps the last good result", async () => {
    const page = await fresh();
    const before = await state(page);
    const mass = page.getByLabel("Mass", { exact: true }).first();
    await mass.fill("-5");
    await page.keyboard.press("Tab");
    const alert = page.getByRole("alert");
    await alert.waitFor();
    const sentence = "scenes/brick_wall.toml: charge.0.mass must be greater than 0, not -5.";
    assert.equal(await alert.textContent(), sentence);
    assert.equal(await mass.getAttribute("aria-invalid"), "true");
    assert.equal((await state(page)).launch, before.launch);
    await screenshot(page, "error");
    await mass.fill("heavy");
    await page.waitForFunction(() => window.brisance.live.error.includes("heavy"));
    await answer(page, async () => {
      await mass.fill("100");
      await page.keyboard.press("Tab");
    });
    assert.equal(await alert.isVisible(), false);
    assert.equal(await mass.getAttribute("aria-invalid"), null);
    assert.equal((await state(page)).launch, before.launch);
  });

  test("dragging a name turns its number", async () => {
    const page = await fresh();
    const label = page.locator("label", { hasText: /^Mass$/i }).first();
    const box = await label.boundingBox();
    await answer(page, async () => {
      await page.mouse.move(box.x + 5, box.y + 5);
      await page.mouse.down();
      await page.mouse.move(box.x + 55, box.y + 5, { steps: 5 });
      await page.mouse.up();
    });
    // Fifty pixels of 0.6 % each, compounded.
    assert.ok(Math.abs((await scene(page)).charge[0].mass - 100 * Math.exp(0.3)) < 0.1);
  });

  test("every kind of control writes what the scene expects", async () => {
    const page = await fresh();
    for (const part of await page.locator(".side details").all())
      await part.evaluate((one) => {
        one.open = true;
      });
    await answer(page, () => page.getByLabel("Burst").selectOption("surface"));
    await answer(page, () => page.getByLabel("Enabled").setChecked(false));
    await answer(page, async () => {
      await page.getByLabel("Clearing").fill("0.5");
      await page.keyboard.press("Tab");
    });
    await answer(page, async () => {
      await page.getByLabel("Explosive").fill("PETN");
      await page.keyboard.press("Tab");
    });
    await answer(page, async () => {
      await page.getByLabel("Rows").fill("8");
      await page.keyboard.press("Tab");
    });
    await answer(page, async () => {
      await page.getByLabel("Damping factor").focus();
      await page.keyboard.press("ArrowUp");
    });
    const now = await scene(page);
    assert.equal(now.charge[0].burst, "surface");
    assert.equal(now.charge[0].explosive, "PETN");
    assert.equal(now.occlusion.enabled, false);
    assert.equal(now.loading.clearing, 0.5);
    assert.equal(now.brick_wall[0].rows, 8);
    assert.equal(now.dynamics.damping_factor, 1.1);
    assert.equal(await page.evaluate(() => window.brisance.viewer.recording.pieces), 8 * 4 + 4);
    assert.equal((await state(page)).error, "");
    await answer(page, async () => {
      await page.getByLabel("Clearing").fill("");
      await page.keyboard.press("Tab");
    });
    assert.ok(
      !("clearing" in (await scene(page)).loading),
      "an emptied control gives the key back to its default",
    );
  });

  test("an object that the page has never heard of has its controls, too", async () => {
    const page = await here.browser.newPage(SMALL);
    const number = { type: "number", exclusiveMinimum: 0 };
    await page.route("**/api/schema", async (route) => {
      const schema = await (await route.fetch()).json();
      schema.$defs.Pattern = {
        type: "object",
        properties: {
          pieces: {
            anyOf: [{ type: "integer" }, { type: "null" }],
            default: null,
            description: "How many [1].",
          },
          seeds: {
            type: "array",
            items: { type: "array", prefixItems: [number, number] },
            description: "Where.",
          },
        },
      };
      schema.$defs.Window = {
        type: "object",
        required: ["width"],
        properties: {
          width: { ...number, description: "Width [m]." },
          pattern: { $ref: "#/$defs/Pattern", description: "How it breaks." },
        },
      };
      schema.properties.window = { type: "array", items: { $ref: "#/$defs/Window" }, description: "Panes." };
      await route.fulfill({ json: schema });
    });
    await page.route("**/api/scenes/*", async (route) => {
      const opened = await (await route.fetch()).json();
      opened.scene.window = [{ name: "left", width: 1.5, pattern: {} }, { width: 2 }];
      await route.fulfill({ json: opened });
    });
    await page.goto(here.server.address);
    const pieces = page.locator('[data-key="window.0.pattern.pieces"] input');
    await pieces.waitFor({ state: "attached" });
    const fill = (key, value) =>
      page.evaluate(
        ([key_, value_]) => {
          const input = document.querySelector(`[data-key="${key_}"] input`);
          input.value = value_;
          input.dispatchEvent(new Event("input", { bubbles: true }));
        },
        [key, value],
      );
    await fill("window.0.pattern.pieces", "300");
    await fill("window.1.pattern.seeds", "[[0.5, 0.25]]");
    await fill("window.1.width", "2.5");
    assert.deepEqual((await scene(page)).window, [
      { name: "left", width: 1.5, pattern: { pieces: 300 } },
      { width: 2.5, pattern: { seeds: [[0.5, 0.25]] } },
    ]);
    await page.close();
  });

  test("another scene opens from the list", async () => {
    const page = await fresh();
    await answer(page, () => page.getByLabel("Scene to open").selectOption("crates.toml"));
    const now = await state(page);
    assert.equal(now.name, "crates");
    await showFrame(page, 22);
    await screenshot(page, "crates");
    assert.deepEqual(page.problems, []);
  });

  test("what is saved is the scene as it stands", async () => {
    const page = await fresh();
    await answer(page, async () => {
      await page.getByLabel("Mass", { exact: true }).first().fill("77");
      await page.keyboard.press("Enter");
    });
    for (const [name, file] of [
      ["Scene (.toml)", "brick_wall.toml"],
      ["Animation (.usdc)", "brick_wall.usdc"],
      ["Animation (.glb)", "brick_wall.glb"],
      ["Picture (.png)", "brick_wall.png"],
    ]) {
      await page.getByRole("button", { name: "Save" }).click();
      const [download] = await Promise.all([
        page.waitForEvent("download"),
        page.getByRole("button", { name }).click(),
      ]);
      assert.equal(download.suggestedFilename(), file);
      const bytes = await readFile(await download.path());
      const begins = { toml: "name", usdc: "PXR-USDC", glb: "glTF", png: "\u0089PNG" }[file.split(".")[1]];
      assert.equal(bytes.subarray(0, begins.length).toString("latin1"), begins);
      if (file.endsWith(".toml")) assert.match(bytes.toString(), /^mass = 77(\.0)?$/m);
    }
    assert.deepEqual(page.problems, []);
  });
});

describe("a piece", () => {
  test("shows its facts and its pressure when clicked, and fills the picture with F", async () => {
    const page = await fresh();
    await showFrame(page, 0);
    const [x, y] = await page.evaluate(() => {
      const { viewer, poseAt } = window.brisance;
      return viewer.stage.onPage(poseAt(viewer.recording, 10, 0).position);
    });
    await page.mouse.click(x, y);
    assert.equal((await state(page)).selected, 10);
    const truth = (await python(POSITIONS)).facts[10];
    const panel = page.getByRole("region", { name: "Piece" });
    assert.match(await panel.textContent(), new RegExp(truth.name));
    assert.match(await panel.textContent(), new RegExp(`Mass${truth.mass_kg.toPrecision(3)} kg`));
    assert.match(
      await panel.textContent(),
      new RegExp(`Arrival${(1e3 * truth.arrival_time_s).toPrecision(3)} ms`),
    );
    const inked = await panel.locator("canvas").evaluate((canvas) => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      return data.filter((value, index) => index % 4 === 3 && value > 0).length;
    });
    assert.ok(inked > 2000, "the curve is drawn");
    const distance = () =>
      page.evaluate(() => {
        const { viewer, poseAt } = window.brisance;
        const [x, y, z] = poseAt(viewer.recording, 10, 0).position;
        const { position } = viewer.stage.camera;
        return Math.hypot(position.x - x, position.y - y, position.z - z);
      });
    const before = await distance();
    await page.setViewportSize({ width: 1280, height: 800 });
    await drawn(page);
    await screenshot(page, "piece");
    await page.setViewportSize(SIZE);
    await page.keyboard.press("f");
    assert.ok((await distance()) < before);
    await page.keyboard.press("Escape");
    assert.equal((await state(page)).selected, -1);
  });

  test("stays selected when the scene is simulated again", async () => {
    const page = await fresh();
    await page.evaluate(() => window.brisance.viewer.select(5));
    await answer(page, async () => {
      await page.getByLabel("Mass", { exact: true }).first().fill("80");
      await page.keyboard.press("Enter");
    });
    assert.equal((await state(page)).selected, 5);
  });
});

describe("the timeline", () => {
  test("obeys the keyboard", async () => {
    const page = await fresh();
    const frame = async () => Math.round((await state(page)).time * 1e6) / 1e4;
    await page.keyboard.press("Home");
    assert.equal(await frame(), 0);
    await page.keyboard.press(".");
    await page.keyboard.press(".");
    assert.equal(await frame(), 2);
    await page.keyboard.press(",");
    assert.equal(await frame(), 1);
    await page.keyboard.press("ArrowRight");
    assert.equal(await frame(), 3);
    await page.keyboard.press("End");
    assert.equal(await frame(), 40);
    await page.keyboard.press("Home");
    await page.getByLabel("Speed", { exact: true }).selectOption("1000");
    await page.locator("canvas").first().focus();
    await page.keyboard.press(" ");
    assert.equal((await state(page)).playing, true);
    await page.waitForFunction(() => window.brisance.viewer.timeline.time > 0.0005);
    await page.keyboard.press(" ");
    const { time, playing } = await state(page);
    assert.equal(playing, false);
    assert.ok(time < 0.02, "a thousandth is slow");
  });

  test("does not start by itself where motion is unwelcome", async () => {
    const still = await fresh();
    assert.equal((await state(still)).playing, false);
    assert.equal((await state(still)).time, 0);
    const page = await open(here.browser, here.server.address, {
      ...SMALL,
      reducedMotion: "no-preference",
    });
    assert.equal((await state(page)).playing, true);
    await page.close();
  });
});
