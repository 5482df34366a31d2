// SPDX-License-Identifier: BSD-3-Clause
// Where a robot shall go, and what it meets.
import type { PathAnswer } from "../api/types";
import { lengthOf_m, readPath, writePath } from "../state/path_text";
import { robotLimits } from "../state/robot";
import type { RobotPath, ViewStore } from "../state/view";
import { button, el } from "./dom";
import { metres, numberField, table } from "./fields";

/** Stays as it is while one types in it. */
export function newPathCard(store: ViewStore): HTMLElement {
  const text = el("textarea", { class: "waypoints", aria: { label: "Waypoints: x y z in metres, one a line" } });
  [text.rows, text.spellcheck] = [3, false];
  text.placeholder = "Click places on the floor, or paste: x y [z], one a line, or JSON";
  const trouble = el("p", { class: "trouble", role: "alert", hidden: true });
  const verdict = el("div", { role: "status" });
  const robot = el("div", { class: "numbers" });
  const unseen = el("input", { type: "checkbox" });
  const change = (part: Partial<RobotPath>) => store.set("path", { ...store.get("path"), ...part });
  const take = () => {
    try {
      change({ points_m: readPath(text.value) });
      trouble.hidden = true;
    } catch (error) {
      trouble.textContent = error instanceof Error ? error.message : String(error);
      trouble.hidden = false;
    }
  };
  text.addEventListener("input", take);
  text.addEventListener("keydown", (event) => {
    event.stopPropagation();
    if (event.key === "Escape") text.blur();
  });
  unseen.addEventListener("change", () => change({ seenAlone: unseen.checked }));
  const card = el(
    "section",
    { class: "card path" },
    el("h2", {}, "Path of a robot"),
    text,
    trouble,
    robot,
    el("label", { class: "check" }, unseen, "Keep to what was seen"),
    verdict,
    el(
      "div",
      { class: "buttons" },
      button(null, "Back one", "Take the last place away", () =>
        change({ points_m: store.get("path").points_m.slice(0, -1) }),
      ),
      button(null, "Clear", "Take all places away", () => change({ points_m: [] })),
    ),
    button("close", "", "Put the path away", () => {
      change({ points_m: [] });
      store.set("tool", "select");
    }),
  );
  store.follow(["path", "tool"], () => {
    const path = store.get("path");
    card.hidden = store.get("tool") !== "path" && path.points_m.length === 0;
    unseen.checked = path.seenAlone;
    if (document.activeElement !== text) {
      text.value = writePath(path.points_m);
      trouble.hidden = true;
    }
    if (!robot.contains(document.activeElement)) robot.replaceChildren(...robotFields(path, change));
  });
  store.follow(["path", "pathAnswer", "objects"], () =>
    verdict.replaceChildren(...verdictOf(store, store.get("pathAnswer"))),
  );
  return card;
}

function robotFields(path: RobotPath, change: (part: Partial<RobotPath>) => void): HTMLElement[] {
  const within = (value: number, [least, most]: readonly [number, number]) => Math.min(most, Math.max(least, value));
  return [
    numberField("Radius", metres(path.radius_m), "m", false, (value) =>
      change({ radius_m: within(value, robotLimits.radius_m) }),
    ),
    numberField("Height", metres(path.height_m), "m", false, (value) =>
      change({ height_m: within(value, robotLimits.height_m) }),
    ),
  ];
}

function verdictOf(store: ViewStore, answer: PathAnswer | null): HTMLElement[] {
  const { points_m } = store.get("path");
  if (points_m.length === 0) return [];
  if (!answer) return [el("p", { class: "muted" }, "Asking…")];
  const named = (id: string) => {
    const label = store.get("objects").get(id)?.label ?? `#${id}`;
    return button(null, label, `Select ${label}`, () => store.set("selected", id));
  };
  const { contact, clearance } = answer;
  if (!contact) {
    const rows: [string, string][] = [["Length", `${metres(lengthOf_m(points_m))} m`]];
    if (clearance) {
      const of = clearance.id === null ? "" : ` to ${store.get("objects").get(clearance.id)?.label ?? clearance.id}`;
      rows.push(["Nearest", `${metres(clearance.distance_m)} m${of}`]);
    }
    return [el("p", { class: "good" }, "Free to go"), table(rows)];
  }
  const from = points_m[contact.waypoint];
  const to = points_m[contact.waypoint + 1];
  const along = from && to ? contact.fraction * lengthOf_m([from, to]) : 0;
  const after_m = lengthOf_m(points_m, contact.waypoint + 1) + along;
  return [
    el(
      "p",
      { class: "collision" },
      after_m < 0.005 ? "Where it starts it touches " : `After ${metres(after_m)} m it touches `,
      contact.id === null ? "what nobody has seen" : named(contact.id),
    ),
  ];
}
