// SPDX-License-Identifier: BSD-3-Clause
import type { Edits } from "../actions/edits";
import type { Renderer } from "../scene/renderer";
import { nameOfEdit } from "../state/history";
import { numListed } from "../state/objects";
import type { ColourMode, Tool, ViewStore } from "../state/view";
import { button, el } from "./dom";

const toast_ms = 9000;

const legends: { readonly [Mode in ColourMode]?: string } = {
  confidence: "Amber: its class is not certain. Grey: nearly all views agree.",
  "last seen": "Amber: not seen for the longest. Grey: seen last.",
  presence: "Amber: gone, or not known. Grey: there.",
};

const hints: { readonly [Name in Tool]?: string } = {
  ray: "Click where the ray begins, then what it goes through. D ends it.",
  measure: "Click one end on a surface, then the other. M ends it.",
  region: "Click one corner on the floor, then the opposite one. I ends it.",
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
    store.follow(["toast", "tool", "selected", "link", "colour", "touched", "draft", "walks", "at"], () => this.say());
    store.follow(["objects", "phase", "showsGone", "robots"], () => this.count());
  }

  count(): void {
    const triangles = this.renderer.numTriangles;
    const num = this.store.get("robots").filter(({ isFeeding }) => isFeeding).length;
    const feeding = num === 0 ? "" : `${num === 1 ? "a robot maps" : `${num} robots map`} · `;
    this.amount.textContent =
      triangles === 0
        ? ""
        : `${feeding}${numListed(this.store.get("objects").values(), this.store.get("showsGone"))} objects · ${Math.round(triangles / 1000)} k triangles · ${(this.renderer.meshBytes / 1e6).toFixed(1)} MB`;
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
    const undoRevision = this.store.get("at") === null ? toast.undoRevision : undefined;
    this.said.replaceChildren(
      toast.text,
      ...(undoRevision === undefined
        ? []
        : [button("undo", "Undo", `Undo: ${nameOfEdit(this.store, undoRevision)}`, () => void this.edits.undo(undoRevision))]),
    );
    this.timer = window.setTimeout(() => this.store.set("toast", null), toast_ms);
  }

  private hint(): string {
    if (this.store.get("link") === "lost")
      return "The server does not answer. What is shown is as it was; it goes on by itself.";
    if (this.store.get("at") !== null && this.store.get("tool") === "select")
      return "This is how it was; look and ask, nothing can be changed. , and . go back and on, N back to now.";
    if (this.store.get("tool") === "probe")
      return "Click a point: what is there, how far is the nearest surface. P ends it.";
    if (this.store.get("walks")) return "Arrow keys walk, Shift faster, a drag looks around. W or Esc goes back up.";
    if (this.store.get("tool") === "path") return "Click places on the floor: the robot goes from one to the next. R ends it.";
    const hint = hints[this.store.get("tool")];
    if (hint) return hint;
    if (this.store.get("draft")?.is === "merge") return "Click what shall become a part of it. Esc leaves it.";
    const legend = legends[this.store.get("colour")];
    if (legend) return legend;
    if (this.store.get("selected") !== null)
      return "Drag it to move it, its ring to turn it. F goes there, X hides it, Esc lets go.";
    return "Drag to turn, right drag to shift, wheel to come nearer. Click an object. / searches, ? has all keys.";
  }
}
