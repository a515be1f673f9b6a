// A little help with elements.

type Attributes = Record<string, string | number | boolean | undefined>;
type Child = Node | string;

/** An element with attributes and children; an attribute that is true is present, one that is false or undefined is not. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== undefined) element.setAttribute(name, String(value));
  }
  element.append(...children);
  return element;
}

/** An icon drawn in a square of 24. */
export function icon(path: string): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  const shape = document.createElementNS("http://www.w3.org/2000/svg", "path");
  shape.setAttribute("d", path);
  svg.append(shape);
  return svg;
}

/** A button with an icon, or with text, and a name for those who cannot see it. */
export function button(name: string, face: string | SVGElement, pressed: () => void): HTMLButtonElement {
  const made = make("button", { type: "button", "aria-label": name, title: name }, face);
  made.addEventListener("click", pressed);
  return made;
}

/** A number for people: three or four digits. */
export function shown(value: number, digits = 3): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) return value.toExponential(digits - 1);
  return size >= 10 ** digits ? String(Math.round(value)) : value.toPrecision(digits);
}

/** Save bytes under a name. */
export function download(name: string, data: Blob): void {
  const link = make("a", { href: URL.createObjectURL(data), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
