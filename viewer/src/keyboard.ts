// Keys that work wherever the focus is, except where one types.

export type Keys = Record<string, () => void>;

export function listenToKeys(keys: Keys): void {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target as HTMLElement;
    const types = target.closest(
      "input:not([type=range], [type=checkbox]), select, textarea, [contenteditable]",
    );
    if (types) return;
    // A button or a switch has its own use of the space bar.
    if (event.key === " " && target.closest("button, summary, a, [type=checkbox]")) return;
    const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
