// SPDX-License-Identifier: BSD-3-Clause
// The facts of what is selected, what was done to it, and how to ask for it elsewhere.
import type { Edits } from "../actions/edits";
import type { MapObject } from "../api/types";
import { classColour, cssColour } from "../scene/colours";
import type { ViewStore } from "../state/view";
import type { MoveTool } from "../tools/move";
import { classCard } from "./class_card";
import { button, el } from "./dom";
import { newDraftCard } from "./draft_card";
import { actionsCard, logCard } from "./edit_cards";
import { factsCard } from "./facts_card";
import { nearCard } from "./near_card";
import { poseCard } from "./pose_card";
import { probeCard } from "./probe_card";

export class Inspector {
  readonly element = el("aside", { class: "panel inspector", aria: { label: "Selection" } });

  private readonly cardsOfAll = el("div");
  private readonly toolCards: readonly HTMLElement[];

  constructor(
    private readonly store: ViewStore,
    private readonly edits: Edits,
    private readonly moveTool: MoveTool,
    private readonly focusOn: (id: string) => void,
    toolCards: readonly HTMLElement[],
  ) {
    this.element.append(...toolCards, newDraftCard(store, edits), this.cardsOfAll);
    this.toolCards = toolCards;
    store.follow(
      [
        "selected",
        "objects",
        "history",
        "pending",
        "probe",
        "undoable",
        "slice_m",
        "tool",
        "path",
        "draft",
        "at",
        "ray",
        "measured_m",
        "clip",
        "near",
        "asksNear",
        "nearClass",
      ],
      () => this.draw(),
    );
  }

  private draw(): void {
    if (this.isBeingTypedIn()) return;
    const object = this.store.get("objects").get(this.store.get("selected") ?? "");
    this.element.dataset["id"] = object?.id ?? "";
    const probe = probeCard(this.store);
    // They have followed the same keys before.
    this.element.hidden = !object && !probe && this.toolCards.every((card) => card.hidden);
    document.body.classList.toggle("has-inspector", !this.element.hidden);
    this.cardsOfAll.replaceChildren(...(probe ? [probe] : []), ...(object ? this.cards(object) : []));
  }

  /** What is typed is not written over by what comes from the map. */
  private isBeingTypedIn(): boolean {
    const { activeElement } = document;
    const isSame = this.element.dataset["id"] === (this.store.get("selected") ?? "");
    const isInput =
      (activeElement instanceof HTMLInputElement && activeElement.type !== "range") ||
      activeElement instanceof HTMLSelectElement;
    return isSame && isInput && this.cardsOfAll.contains(activeElement);
  }

  private cards(object: MapObject): HTMLElement[] {
    const { store, edits, moveTool } = this;
    let newest_ns = 0n;
    for (const { lastSeen_ns } of store.get("objects").values()) if (lastSeen_ns > newest_ns) newest_ns = lastSeen_ns;
    return [
      this.head(object),
      factsCard(object, newest_ns),
      ...[classCard(store, edits, object)].filter((card) => card !== null),
      poseCard(store, moveTool, object),
      nearCard(store, object),
      logCard(store, edits, object),
      actionsCard(store, edits, object),
    ];
  }

  private head(object: MapObject): HTMLElement {
    const { store } = this;
    const swatch = el("span", { class: "swatch large" });
    swatch.style.background = cssColour(classColour(object));
    const name = el("input", {
      class: "title",
      value: object.label,
      disabled: store.get("at") !== null,
      aria: { label: "Name of the object" },
      title: "Enter renames; empty: the class's name",
    });
    name.addEventListener("keydown", (event) => {
      if (event.key === "Enter") {
        name.blur();
        if (name.value !== object.label) void this.edits.rename(object, name.value);
      }
      if (event.key === "Escape") {
        name.value = object.label;
        name.blur();
      }
      event.stopPropagation();
    });
    return el(
      "header",
      { class: "card-head" },
      swatch,
      name,
      button("frame", "", "Go there (F)", () => this.focusOn(object.id)),
      button("close", "", "Let go (Esc)", () => store.set("selected", null)),
    );
  }
}
