// SPDX-License-Identifier: BSD-3-Clause
// Everything in the map by class: search, select, hide.
import type { MapObject } from "../api/types";
import { classColour, cssColour } from "../scene/colours";
import { groupByClass, isShown, toggled, type ClassGroup } from "../state/objects";
import type { ViewStore } from "../state/view";
import { button, el, icon } from "./dom";

export class ObjectList {
  readonly element: HTMLElement;
  readonly search = el("input", {
    type: "search",
    class: "search",
    placeholder: "Search objects",
    aria: { label: "Search objects" },
  });
  private readonly rows = el("div", { class: "rows" });
  private readonly count = el("span", { class: "count" });
  private readonly goneBox = el("input", { type: "checkbox" });
  private readonly folded = new Set<string>();
  private asked = false;

  constructor(
    private readonly store: ViewStore,
    private readonly focusOn: (id: string) => void,
  ) {
    const gone = el(
      "label",
      { class: "check", title: "What is kept of objects that are no longer there" },
      this.goneBox,
      "Show gone",
    );
    const all = button(null, "Show all", "Show everything that is hidden", () => {
      store.set("hiddenClasses", new Set());
      store.set("hiddenObjects", new Set());
    });
    this.element = el(
      "aside",
      { class: "panel list", aria: { label: "Objects" } },
      el("div", { class: "panel-head" }, this.search, el("kbd", {}, "/")),
      el("div", { class: "panel-tools" }, this.count, gone, all),
      this.rows,
    );
    this.search.addEventListener("input", () => store.set("query", this.search.value));
    this.search.addEventListener("keydown", (event) => this.searchKey(event));
    this.goneBox.addEventListener("change", () => store.set("showsGone", this.goneBox.checked));
    this.rows.addEventListener("keydown", (event) => this.rowKey(event));
    store.follow(["objects", "query", "hiddenClasses", "hiddenObjects", "showsGone"], () => this.ask());
    store.follow(["selected"], () => this.mark());
    store.follow(["query"], () => {
      if (this.search.value !== store.get("query")) this.search.value = store.get("query");
    });
    store.follow(["showsGone"], () => {
      this.goneBox.checked = store.get("showsGone");
    });
  }

  /** Once a frame at most: a live map changes often. */
  private ask(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.draw();
    });
  }

  private draw(): void {
    const focused = document.activeElement instanceof HTMLElement ? document.activeElement.dataset["key"] : undefined;
    const groups = groupByClass(
      this.store.get("objects").values(),
      this.store.get("query"),
      this.store.get("showsGone"),
    );
    const num = groups.reduce((sum, group) => sum + group.objects.length, 0);
    this.count.textContent = `${num} ${num === 1 ? "object" : "objects"}`;
    this.rows.replaceChildren(...groups.map((group) => this.group(group)));
    if (num === 0)
      this.rows.append(
        el(
          "p",
          { class: "empty" },
          this.store.get("query") ? "Nothing is called that. Esc clears the search." : "No objects yet.",
        ),
      );
    this.mark();
    if (focused) this.rows.querySelector<HTMLElement>(`[data-key="${CSS.escape(focused)}"]`)?.focus();
  }

  private group({ className, objects }: ClassGroup): HTMLElement {
    const first = objects[0];
    const isHidden = this.store.get("hiddenClasses").has(className);
    const isOne = objects.length === 1;
    const isFolded = this.folded.has(className) && this.store.get("query") === "";
    const head = el(
      "div",
      { class: `class-row${isHidden ? " is-hidden" : ""}` },
      el(
        "button",
        {
          type: "button",
          class: "class-name",
          data: { key: `class ${className}`, ...(isOne && first ? { id: first.id } : {}) },
          aria: isOne ? {} : { expanded: String(!isFolded) },
          onClick: () => (isOne && first ? this.store.set("selected", first.id) : this.fold(className)),
        },
        swatch(first),
        el("span", { class: "name" }, isOne && first ? first.label : className),
        isOne && first ? notesOf(first) : el("span", { class: "count" }, String(objects.length)),
      ),
      this.eye(`eye ${className}`, isHidden, className, () =>
        this.store.set("hiddenClasses", toggled(this.store.get("hiddenClasses"), className)),
      ),
    );
    return el(
      "section",
      { class: "class-group" },
      head,
      ...(isOne || isFolded ? [] : objects.map((object) => this.row(object))),
    );
  }

  private row(object: MapObject): HTMLElement {
    const view = {
      hiddenClasses: this.store.get("hiddenClasses"),
      hiddenObjects: this.store.get("hiddenObjects"),
      showsGone: this.store.get("showsGone"),
    };
    const row = el(
      "div",
      { class: `row${isShown(object, view) ? "" : " is-hidden"}` },
      el(
        "button",
        {
          type: "button",
          class: "row-name",
          data: { key: `row ${object.id}`, id: object.id },
          title: "Click selects, double click goes there",
          onClick: () => this.store.set("selected", object.id),
        },
        el("span", { class: "name" }, object.label),
        notesOf(object),
        object.label.endsWith(object.id) ? null : el("span", { class: "id" }, `#${object.id}`),
      ),
      this.eye(`eye ${object.id}`, view.hiddenObjects.has(object.id), object.label, () =>
        this.store.set("hiddenObjects", toggled(this.store.get("hiddenObjects"), object.id)),
      ),
    );
    row.addEventListener("dblclick", () => this.focusOn(object.id));
    row.addEventListener("pointerenter", () => this.store.set("hovered", object.id));
    row.addEventListener("pointerleave", () => this.store.set("hovered", null));
    return row;
  }

  private eye(key: string, isHidden: boolean, what: string, onClick: () => void): HTMLElement {
    const eye = button(isHidden ? "hidden" : "eye", "", `${isHidden ? "Show" : "Hide"} ${what}`, onClick);
    eye.classList.add("eye");
    eye.dataset["key"] = key;
    eye.setAttribute("aria-pressed", String(isHidden));
    return eye;
  }

  private fold(className: string): void {
    if (!this.folded.delete(className)) this.folded.add(className);
    this.draw();
  }

  private mark(): void {
    const selected = this.store.get("selected");
    for (const row of this.rows.querySelectorAll<HTMLElement>("[data-id]")) {
      const isSelected = row.dataset["id"] === selected;
      row.parentElement?.classList.toggle("is-selected", isSelected);
      row.setAttribute("aria-current", String(isSelected));
      if (isSelected) row.scrollIntoView({ block: "nearest" });
    }
  }

  private searchKey(event: KeyboardEvent): void {
    if (event.key === "Escape") {
      this.store.set("query", "");
      this.search.blur();
    } else if (event.key === "Enter" || event.key === "ArrowDown") {
      if (this.asked) this.draw(); // who types fast means what is found, not what is still listed
      const first = this.rows.querySelector<HTMLElement>(".row-name, .class-name[data-id]");
      first?.focus();
      if (event.key === "Enter") first?.click();
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  }

  private rowKey(event: KeyboardEvent): void {
    if (event.key !== "ArrowDown" && event.key !== "ArrowUp") return;
    const stops = [...this.rows.querySelectorAll<HTMLElement>(".row-name, .class-name")];
    const at = stops.indexOf(document.activeElement as HTMLElement);
    const next = stops[at + (event.key === "ArrowDown" ? 1 : -1)];
    if (!next) return;
    next.focus();
    if (next.dataset["id"]) this.store.set("selected", next.dataset["id"]);
    event.preventDefault();
    event.stopPropagation();
  }
}

function notesOf(object: MapObject): Element | null {
  if (!object.isPresent) return el("span", { class: "tag stale" }, "gone");
  return object.isLocked ? icon("lock") : null;
}

function swatch(object: MapObject | undefined): HTMLElement {
  const mark = el("span", { class: "swatch" });
  if (object) mark.style.background = cssColour(classColour(object));
  return mark;
}
