// The scene as controls, built from the schema of its model: whatever a scene may hold, the page can turn.

import type { Tables } from "./connection";
import { make } from "./dom";
import { type Kind, kindOf, resolved, type Schema, unitOf } from "./schema";

type Path = (string | number)[];

/** Tables that stand first and open; the others follow in the schema's order. */
const FIRST = ["charge", "time", "dynamics", "occlusion", "loading"];
const OPEN = ["charge", "charge.0", "time"];

export class Controls {
  readonly element = make("form", { class: "controls", "aria-label": "Scene", autocomplete: "off" });
  /** Called when a control is turned; `done` when it is let go. */
  onChange: (done: boolean) => void = () => {};
  private tables: Tables = {};
  private numbers = 0;

  constructor(private readonly root: Schema) {
    this.element.addEventListener("submit", (event) => event.preventDefault());
  }

  get scene(): Tables {
    return this.tables;
  }

  /** Show a scene's tables; they are changed in place. */
  show(tables: Tables): void {
    this.tables = tables;
    this.element.replaceChildren();
    const names = Object.keys(this.root.properties ?? {});
    const rank = (name: string) => (FIRST.includes(name) ? FIRST.indexOf(name) : FIRST.length);
    const scalars = names.filter((name) => !["table", "tables"].includes(this.kind(name).kind));
    const others = names.filter((name) => !scalars.includes(name)).sort((a, b) => rank(a) - rank(b));
    const parts = others.map((name) => this.part(name, [name], this.root.properties?.[name] ?? {}));
    const general = this.section("scene", "scene", "The scene as a whole.");
    for (const name of scalars)
      general.append(this.field(name, [name], this.root.properties?.[name] ?? {}, this.root));
    this.element.append(...parts.slice(0, 1), general, ...parts.slice(1));
    this.element.parentElement?.scrollTo(0, 0);
    for (const part of this.element.querySelectorAll("details"))
      part.open = OPEN.includes(part.dataset.key ?? "");
  }

  /** Write a value from elsewhere (the gizmo) into the scene and its control. */
  set(path: Path, value: unknown): void {
    this.write(path, value);
    const key = path.join(".");
    const inputs = this.element.querySelectorAll<HTMLInputElement>(`[data-key="${CSS.escape(key)}"] input`);
    const parts = Array.isArray(value) ? value : [value];
    inputs.forEach((input, index) => {
      input.value = String(parts[index] ?? "");
    });
  }

  /** Mark the control that a sentence is about, as it begins with the key; none for an empty sentence. */
  blame(sentence: string): void {
    for (const old of this.element.querySelectorAll("[aria-invalid]")) old.removeAttribute("aria-invalid");
    const key = /: ([a-z_]+(?:\.\w+)*)[ .]/.exec(sentence)?.[1];
    if (!key) return;
    const control = this.element.querySelector(`[data-key="${CSS.escape(key)}"]:not(details)`);
    for (const input of control?.querySelectorAll("input, select") ?? [])
      input.setAttribute("aria-invalid", "true");
    for (let part = control?.closest("details"); part; part = part.parentElement?.closest("details"))
      part.open = true;
  }

  private kind(name: string): Kind {
    return kindOf(this.root.properties?.[name] ?? {}, this.root);
  }

  private section(name: string, key: string, description = ""): HTMLDetailsElement {
    const summary = make("summary", { title: description }, plain(name));
    return make("details", { class: "section", "data-key": key }, summary);
  }

  /** A table, or a list of tables, as a section that opens. */
  private part(name: string, path: Path, schema: Schema): HTMLElement {
    const kind = kindOf(schema, this.root);
    const section = this.section(name, path.join("."), schema.description);
    if (kind.kind === "tables") {
      const rows = this.read(path);
      const tables = Array.isArray(rows) ? (rows as Tables[]) : [];
      section.hidden = tables.length === 0;
      tables.forEach((table, index) => {
        const own = typeof table.name === "string" ? table.name : "";
        if (tables.length === 1) {
          if (own && section.firstElementChild) section.firstElementChild.textContent += ` · ${own}`;
          this.fields(section, [...path, index], kind.schema);
          return;
        }
        const inner = this.section(own || `${plain(name)} ${index + 1}`, [...path, index].join("."));
        this.fields(inner, [...path, index], kind.schema);
        section.append(inner);
      });
    } else if (kind.kind === "table") {
      this.fields(section, path, kind.schema);
    }
    return section;
  }

  private fields(into: HTMLElement, path: Path, schema: Schema): void {
    for (const [name, own] of Object.entries(schema.properties ?? {})) {
      const inner = kindOf(own, this.root);
      const deeper = inner.kind === "table" || inner.kind === "tables";
      into.append(
        deeper ? this.part(name, [...path, name], own) : this.field(name, [...path, name], own, schema),
      );
    }
  }

  /** One key: its name, its control, its unit. */
  private field(name: string, path: Path, given: Schema, owner: Schema): HTMLElement {
    const schema = resolved(given, this.root);
    const kind = kindOf(given, this.root);
    const id = `control-${this.numbers++}`;
    const hint = make("span", { class: "hidden", id: `${id}-hint` }, schema.description ?? "");
    const label = make("label", { for: id, title: schema.description }, plain(name));
    const control = this.control(kind, path, schema, id, owner.required?.includes(name) ?? false);
    for (const input of control.querySelectorAll("input, select"))
      input.setAttribute("aria-describedby", hint.id);
    const unit = unitOf(schema.description);
    const row = make(
      "div",
      { class: `field ${kind.kind}`, "data-key": path.join(".") },
      label,
      control,
      hint,
    );
    if (unit) control.append(make("span", { class: "unit", "aria-hidden": true }, unit));
    if (kind.kind === "number") scrub(label, control.querySelector("input") as HTMLInputElement, kind.whole);
    return row;
  }

  private control(kind: Kind, path: Path, schema: Schema, id: string, required: boolean): HTMLElement {
    const value = this.read(path);
    const standard = schema.default;
    const empty = required ? "" : standard === undefined || standard === null ? "auto" : String(standard);
    switch (kind.kind) {
      case "switch": {
        const input = make("input", { type: "checkbox", id, role: "switch" });
        input.checked = (value ?? standard) === true;
        input.addEventListener("change", () => this.turned(path, input.checked, true));
        return make("div", { class: "control" }, input);
      }
      case "choice": {
        const select = make("select", { id });
        for (const choice of kind.choices) select.append(make("option", { value: choice }, choice));
        select.value = String(value ?? standard ?? kind.choices[0]);
        select.addEventListener("change", () => this.turned(path, select.value, true));
        return make("div", { class: "control" }, select);
      }
      case "number": {
        const input = make("input", {
          type: "text",
          inputmode: "decimal",
          id,
          placeholder: empty,
          spellcheck: false,
        });
        input.value = value === undefined || value === null ? "" : String(value);
        steps(input, kind.whole);
        this.listen(input, (text) => this.turned(path, number(text), false));
        return make("div", { class: "control" }, input);
      }
      case "vector": {
        const axes =
          kind.length === 3 ? ["x", "y", "z"] : Array.from({ length: kind.length }, (_, i) => `${i + 1}`);
        const inputs = axes.map((axis, index) => {
          const input = make("input", {
            type: "text",
            inputmode: "decimal",
            "aria-label": `${plain(String(path.at(-1)))} ${axis}`,
            placeholder: String((standard as number[] | null | undefined)?.[index] ?? ""),
            ...(index === 0 ? { id } : {}),
          });
          input.value = Array.isArray(value) ? String(value[index] ?? "") : "";
          steps(input, false);
          return input;
        });
        for (const input of inputs) {
          this.listen(input, () => {
            const parts = inputs.map((part) => number(part.value || part.placeholder));
            this.turned(path, inputs.every((part) => part.value === "") ? undefined : parts, false);
          });
        }
        return make("div", { class: "control axes" }, ...inputs);
      }
      case "text": {
        const input = make("input", { type: "text", id, placeholder: empty, spellcheck: false });
        input.value = value === undefined || value === null ? "" : String(value);
        const list = kind.examples.length > 0 ? this.examples(input, id, kind.examples) : [];
        this.listen(input, (text) =>
          this.turned(path, kind.numbers ? number(text) : text || undefined, false),
        );
        return make("div", { class: "control" }, input, ...list);
      }
      default: {
        const input = make("input", {
          type: "text",
          id,
          placeholder: empty,
          spellcheck: false,
          class: "data",
        });
        input.value = value === undefined || value === null ? "" : JSON.stringify(value);
        this.listen(input, (text) => this.turned(path, data(text), false));
        return make("div", { class: "control" }, input);
      }
    }
  }

  private examples(input: HTMLInputElement, id: string, texts: string[]): HTMLElement[] {
    input.setAttribute("list", `${id}-list`);
    return [make("datalist", { id: `${id}-list` }, ...texts.map((text) => make("option", { value: text })))];
  }

  /** Hear of an input while it is turned and when it is let go. */
  private listen(input: HTMLInputElement, turned: (text: string) => void): void {
    input.addEventListener("input", () => turned(input.value.trim()));
    input.addEventListener("change", () => this.onChange(true));
  }

  private turned(path: Path, value: unknown, done: boolean): void {
    this.write(path, value);
    this.onChange(done);
  }

  private read(path: Path): unknown {
    return path.reduce<unknown>(
      (place, part) => (place as Record<string | number, unknown> | undefined)?.[part],
      this.tables,
    );
  }

  /** Write a value; undefined takes the key out, so that its default holds. */
  private write(path: Path, value: unknown): void {
    let place = this.tables as Record<string | number, unknown>;
    for (const part of path.slice(0, -1)) {
      if (typeof place[part] !== "object" || place[part] === null) {
        if (value === undefined) return;
        place[part] = {};
      }
      place = place[part] as Record<string | number, unknown>;
    }
    const last = path.at(-1) as string | number;
    if (value === undefined) delete place[last];
    else place[last] = value;
  }
}

function plain(name: string): string {
  const words = name.replaceAll("_", " ").replace(/\btnt\b/, "TNT");
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** A text as a number where it is one; else as it stands, for the server to say what is wrong. */
function number(text: string): unknown {
  if (text === "") return undefined;
  const value = Number(text.replace(",", "."));
  return Number.isNaN(value) ? text : value;
}

function data(text: string): unknown {
  if (text === "") return undefined;
  try {
    return JSON.parse(text) as unknown;
  } catch {
    return text;
  }
}

/** Up and down turn a number by a tenth of its size, with Shift by its size, with Alt by a hundredth. */
function steps(input: HTMLInputElement, whole: boolean): void {
  input.addEventListener("keydown", (event) => {
    const way = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    const value = Number(input.value || input.placeholder);
    if (!way || !Number.isFinite(value)) return;
    event.preventDefault();
    const size = 10 ** Math.floor(Math.log10(Math.abs(value) || 1));
    const step = size * (event.shiftKey ? 1 : event.altKey ? 0.01 : 0.1);
    put(input, value + way * (whole ? Math.max(1, Math.round(step)) : step), whole);
    input.dispatchEvent(new Event("change", { bubbles: true }));
  });
}

/** Dragging the name of a number turns it: to the right makes it larger, by shares of its size. */
function scrub(label: HTMLLabelElement, input: HTMLInputElement, whole: boolean): void {
  label.classList.add("scrub");
  label.addEventListener("pointerdown", (event) => {
    const from = Number(input.value || input.placeholder);
    if (!Number.isFinite(from) || event.button !== 0) return;
    label.setPointerCapture(event.pointerId);
    let moved = false;
    const drag = (move: PointerEvent) => {
      const way = move.clientX - event.clientX;
      if (!moved && Math.abs(way) < 3) return;
      moved = true;
      put(input, from === 0 ? way / 100 : from * Math.exp(Math.sign(from) * way * 0.006), whole);
    };
    label.addEventListener("pointermove", drag);
    const end = () => {
      label.removeEventListener("pointermove", drag);
      if (moved) input.dispatchEvent(new Event("change", { bubbles: true }));
    };
    label.addEventListener("pointerup", end, { once: true });
    label.addEventListener("pointercancel", end, { once: true });
    label.addEventListener("click", (click) => moved && click.preventDefault(), { once: true });
  });
}

function put(input: HTMLInputElement, value: number, whole: boolean): void {
  input.value = String(whole ? Math.round(value) : Number(value.toPrecision(4)));
  input.dispatchEvent(new Event("input", { bubbles: true }));
}
