// The page that holds its own recording: no server, no controls, everything else.

import { saveMenu } from "./save";
import { Viewer } from "./viewer";

export async function showAlone(host: HTMLElement, text: string): Promise<Viewer> {
  const viewer = new Viewer(host, false);
  const { page, stage, timeline } = viewer;
  page.tools.prepend(
    saveMenu(
      {
        request: () => ({}),
        picture: () => stage.png(),
        name: () => (viewer.recording?.header.name ?? "scene").replace(/[^\w-]+/g, "_"),
        failed: (sentence) => page.complain(sentence),
      },
      false,
    ),
  );
  try {
    viewer.show(await unpacked(text), true);
    const header = viewer.recording?.header;
    if (header) page.say(`${header.names.length.toLocaleString("en")} pieces · ${header.frames} frames`);
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) timeline.play();
  } catch (error) {
    page.complain(error instanceof Error ? error.message : String(error));
  }
  return viewer;
}

/** The message in a page: packed with gzip, written in base 64. */
async function unpacked(text: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}
