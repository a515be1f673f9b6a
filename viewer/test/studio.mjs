// A server, a browser and one page for all tests of a file.

import { after, before } from "node:test";
import { answer, launch, open, serve } from "./harness.mjs";

/** Above 760 pixels a page has all controls beside it. */
export const SIZE = { width: 820, height: 520 };

/** Starts everything before the tests of the file that calls it, and ends it after them. */
export function studio() {
  let shared;
  const here = {
    server: undefined,
    browser: undefined,
    /** The page that most tests share, on the brick wall as its file has it. */
    async fresh() {
      if (!shared) {
        shared = await open(here.browser, here.server.address, { viewport: SIZE });
      } else {
        await shared.evaluate(() => window.brisance.viewer.select(-1));
        await answer(shared, () => shared.evaluate(() => window.brisance.live.open("brick_wall.toml")));
      }
      return shared;
    },
    scene: (page) => page.evaluate(() => structuredClone(window.brisance.live.scene)),
    state: (page) =>
      page.evaluate(() => {
        const { viewer, live } = window.brisance;
        const { recording, timeline, selected } = viewer;
        return {
          time: timeline.time,
          playing: timeline.isPlaying,
          selected,
          error: live?.error,
          arrival: recording.fact("arrival_time_s", 0),
          launch: recording.fact("launch_speed_m_s", 0),
          name: recording.header.name,
        };
      }),
  };

  before(async () => {
    [here.server, here.browser] = await Promise.all([serve("scenes/brick_wall.toml"), launch()]);
  });

  after(async () => {
    await here.browser?.close();
    here.server?.stop();
  });

  return here;
}
