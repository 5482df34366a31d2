// SPDX-License-Identifier: BSD-3-Clause
import type { Renderer } from "./scene/renderer";
import type { ViewStore } from "./state/view";

/** Dark or light, for the page and the scene. */
export function followTheme(store: ViewStore, renderer: Renderer): void {
  const system = matchMedia("(prefers-color-scheme: light)");
  const apply = () => {
    const theme = store.get("theme");
    document.documentElement.dataset["theme"] = theme === "system" ? (system.matches ? "light" : "dark") : theme;
    const style = getComputedStyle(document.documentElement);
    const [ground, grid, text, unseen, hatch] = ["--ground", "--grid", "--text", "--unseen", "--hatch"].map((name) =>
      style.getPropertyValue(name).trim(),
    );
    renderer.setColours(ground ?? "", grid ?? "", text ?? "", unseen ?? "", hatch ?? "");
  };
  system.addEventListener("change", apply);
  store.follow(["theme"], apply);
}
