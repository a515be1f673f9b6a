// What can be taken away: the scene, its animation, the page itself, the picture.

import { fetched, type Tables } from "./connection";
import { download, make } from "./dom";

const KINDS: [kind: string, name: string][] = [
  ["toml", "Scene (.toml)"],
  ["usdc", "Animation (.usdc)"],
  ["glb", "Animation (.glb)"],
  ["html", "Page (.html)"],
  ["json", "Report (.json)"],
];

interface Source {
  request: () => Tables;
  picture: () => Promise<Blob>;
  name: () => string;
  failed: (sentence: string) => void;
}

/** The menu of what can be saved; without a server, the picture alone. */
export function saveMenu(source: Source, live: boolean): HTMLElement {
  const menu = make(
    "details",
    { class: "menu" },
    make("summary", { role: "button", "aria-label": "Save" }, "Save"),
  );
  const list = make("div", { class: "items" });
  const add = (name: string, data: () => Promise<[string, Blob]>) => {
    const item = make("button", { type: "button" }, name);
    item.addEventListener("click", () => {
      menu.open = false;
      data().then(
        ([file, blob]) => download(file, blob),
        (error: unknown) => source.failed(error instanceof Error ? error.message : String(error)),
      );
    });
    list.append(item);
  };
  if (live) {
    for (const [kind, name] of KINDS) {
      add(name, async () => {
        const response = await fetched(`/api/save/${kind}`, source.request());
        const file = /filename="([^"]+)"/.exec(response.headers.get("content-disposition") ?? "")?.[1];
        return [file ?? `scene.${kind}`, await response.blob()];
      });
    }
  }
  add("Picture (.png)", async () => [`${source.name()}.png`, await source.picture()]);
  menu.append(list);
  document.addEventListener("pointerdown", (event) => {
    if (!menu.contains(event.target as Node)) menu.open = false;
  });
  menu.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || !menu.open) return;
    menu.open = false;
    menu.querySelector("summary")?.focus();
    event.stopPropagation();
  });
  return menu;
}
