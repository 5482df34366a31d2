// SPDX-License-Identifier: BSD-3-Clause
import type { Edits } from "../actions/edits";
import type { Renderer } from "../scene/renderer";
import type { ColourMode, ViewStore } from "../state/view";
import { button, el } from "./dom";

const toast_ms = 9000;

const legends: { readonly [Mode in ColourMode]?: string } = {
  confidence: "Amber: its class is not certain. Grey: nearly all views agree.",
  "last seen": "Amber: not seen for the longest. Grey: seen last.",
  presence: "Amber: gone, or not known. Grey: there.",
};

/** One line: what has just happened, what is under the cursor, how much is shown. */
export class StatusBar {
  readonly element: HTMLElement;
  private readonly said = el("span", { class: "said", role: "status" });
  private readonly amount = el("span", { class: "amount" });
  private timer = 0;

  constructor(
    private readonly store: ViewStore,
    private readonly renderer: Renderer,
    private readonly edits: Edits,
  ) {
    this.element = el("footer", { class: "status" }, this.said, el("span", { class: "gap" }), this.amount);
    store.follow(["toast", "tool", "selected", "link", "colour", "touched"], () => this.say());
    store.follow(["objects", "phase"], () => this.count());
  }

  count(): void {
    const triangles = this.renderer.numTriangles;
    this.amount.textContent =
      triangles === 0
        ? ""
        : `${this.store.get("objects").size} objects · ${Math.round(triangles / 1000)} k triangles · ${(this.renderer.meshBytes / 1e6).toFixed(1)} MB`;
  }

  private say(): void {
    const touched = this.store.get("touched");
    if (touched.length > 0) {
      const names = touched.slice(0, 4).map((id) => this.store.get("objects").get(id)?.label ?? `#${id}`);
      this.said.className = "said collision";
      this.said.replaceChildren(`It would touch ${names.join(", ")}${touched.length > 4 ? " and more" : ""}`);
      return;
    }
    const toast = this.store.get("toast");
    clearTimeout(this.timer);
    this.said.className = `said ${toast?.tone ?? ""}`;
    if (!toast) {
      this.said.replaceChildren(this.hint());
      return;
    }
    const { undoRevision } = toast;
    this.said.replaceChildren(
      toast.text,
      ...(undoRevision === undefined
        ? []
        : [button("undo", "Undo", `Undo revision ${undoRevision}`, () => void this.edits.undo(undoRevision))]),
    );
    this.timer = window.setTimeout(() => this.store.set("toast", null), toast_ms);
  }

  private hint(): string {
    if (this.store.get("link") === "lost")
      return "The server does not answer. What is shown is as it was; it goes on by itself.";
    if (this.store.get("tool") === "probe")
      return "Click a point: what is there, how far is the nearest surface. P ends it.";
    const legend = legends[this.store.get("colour")];
    if (legend) return legend;
    if (this.store.get("selected") !== null)
      return "Drag it to move it, its ring to turn it. F goes there, X hides it, Esc lets go.";
    return "Drag to turn, right drag to shift, wheel to come nearer. Click an object. / searches, ? has all keys.";
  }
}
