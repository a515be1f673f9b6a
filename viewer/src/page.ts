// The page: its parts, where they stand, and the look for dark and light.

import { button, icon, make } from "./dom";
import type { Theme } from "./surroundings";

const SLIDERS = "M4 7h9M17 7h3M4 17h3M11 17h9M15 4v6M9 14v6";
const HALF = "M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18";
const KEY = "brisance-theme";

export class Page {
  readonly view = make("div", { class: "view" });
  readonly bar = make("header", { class: "bar" });
  readonly side = make("aside", { class: "side", id: "side", "aria-label": "Controls" });
  readonly foot = make("footer", { class: "foot" });
  readonly overlay = make("div", { class: "overlay" });
  readonly name = make("h1");
  readonly tools = make("div", { class: "tools" });
  private readonly status = make("p", { class: "status", role: "status" });
  private readonly alert = make("p", { class: "alert", role: "alert", hidden: true });
  private readonly progress = make("progress", { max: 1, "aria-label": "Simulating", hidden: true });
  private readonly chosenTheme = matchMedia("(prefers-color-scheme: dark)");

  constructor(host: HTMLElement, live: boolean, themed: (theme: Theme) => void) {
    const mark = make("span", { class: "mark", "aria-hidden": true });
    this.bar.append(mark, this.name, this.status, this.tools);
    const theme = button("Dark or light", icon(HALF), () => {
      const next = this.theme === "dark" ? "light" : "dark";
      storage()?.setItem(KEY, next);
      this.setTheme(next, themed);
    });
    this.tools.append(theme);
    if (live) {
      const toggle = button("Controls", icon(SLIDERS), () => {
        const shown = document.body.classList.toggle("side-shown");
        toggle.setAttribute("aria-expanded", String(shown));
      });
      toggle.className = "toggle";
      toggle.setAttribute("aria-controls", "side");
      toggle.setAttribute("aria-expanded", "false");
      this.tools.append(toggle);
    }
    this.overlay.append(this.alert);
    const main = make("main", {}, this.view, this.overlay, this.progress);
    host.append(this.bar, main, this.foot);
    if (live) host.append(this.side);
    document.body.classList.toggle("alone", !live);
    this.chosenTheme.addEventListener("change", () => this.setTheme(this.wanted(), themed));
    this.setTheme(this.wanted(), themed);
  }

  get theme(): Theme {
    return document.documentElement.dataset.theme === "light" ? "light" : "dark";
  }

  /** A sentence about what is wrong; empty when nothing is. */
  complain(sentence: string): void {
    this.alert.hidden = sentence === "";
    this.alert.textContent = sentence;
  }

  say(text: string): void {
    this.status.textContent = text;
  }

  showProgress(progress: [number, number] | null): void {
    this.progress.hidden = progress === null;
    if (!progress) return;
    if (progress[1] > 0) this.progress.value = progress[0] / progress[1];
    else this.progress.removeAttribute("value");
  }

  private wanted(): Theme {
    const kept = storage()?.getItem(KEY);
    return kept === "dark" || kept === "light" ? kept : this.chosenTheme.matches ? "dark" : "light";
  }

  private setTheme(theme: Theme, themed: (theme: Theme) => void): void {
    document.documentElement.dataset.theme = theme;
    themed(theme);
  }
}

/** Storage is refused to some pages that open from disk. */
function storage(): Storage | null {
  try {
    return localStorage;
  } catch {
    return null;
  }
}
