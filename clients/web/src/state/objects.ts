// SPDX-License-Identifier: BSD-3-Clause
// Which objects are shown, found and listed. No DOM, no scene.
import type { MapObject, ObjectChange } from "../api/types";
import type { ViewState } from "./view";

type Shown = Pick<ViewState, "hiddenClasses" | "hiddenObjects" | "showsGone">;

export function isShown(object: MapObject, view: Shown): boolean {
  return (
    (object.isPresent || view.showsGone) &&
    !view.hiddenClasses.has(object.className) &&
    !view.hiddenObjects.has(object.id)
  );
}

/** Whether all words of the search are in the object's name, class or id. Nothing searched for: it does. */
export function isFound(object: MapObject, query: string): boolean {
  const text = `${object.label} ${object.className} #${object.id}`.toLowerCase();
  return query
    .toLowerCase()
    .split(/\s+/)
    .every((word) => text.includes(word));
}

export interface ClassGroup {
  readonly className: string;
  readonly kind: MapObject["kind"];
  readonly objects: readonly MapObject[];
}

const isListed = (object: MapObject, showsGone: boolean): boolean =>
  object.sphere !== null && (object.isPresent || showsGone);

export function numListed(objects: Iterable<MapObject>, showsGone: boolean): number {
  let num = 0;
  for (const object of objects) if (isListed(object, showsGone)) ++num;
  return num;
}

/** Found objects by class: things first, then backgrounds, then what is not known; each by name, natural order. */
export function groupByClass(objects: Iterable<MapObject>, query: string, showsGone: boolean): readonly ClassGroup[] {
  const groups = new Map<string, MapObject[]>();
  for (const object of objects) {
    if (!isListed(object, showsGone) || !isFound(object, query)) continue;
    const group = groups.get(object.className);
    if (group) group.push(object);
    else groups.set(object.className, [object]);
  }
  const order = { thing: 0, stuff: 1, unknown: 2 } as const;
  return [...groups.entries()]
    .map(([className, members]): ClassGroup => ({
      className,
      kind: members[0]?.kind ?? "unknown",
      objects: members.sort((a, b) => a.label.localeCompare(b.label, "en", { numeric: true })),
    }))
    .sort((a, b) => order[a.kind] - order[b.kind] || a.className.localeCompare(b.className, "en"));
}

const isSamePose = (a: MapObject, b: MapObject): boolean => JSON.stringify(a.pose) === JSON.stringify(b.pose);

/** Events come without boxes where those would have to be read from the disk: the last one known is nearly right. */
const withKnownBox = (object: MapObject, held: MapObject | undefined): MapObject =>
  object.box || !held?.box || !isSamePose(object, held)
    ? object
    : { ...object, box: held.box, footprint_m: held.footprint_m };

/** The objects after the changes: another map, so that who follows hears of it. */
export function withChanges(objects: ReadonlyMap<string, MapObject>, changes: readonly ObjectChange[]) {
  const after = new Map(objects);
  for (const change of changes) {
    if (change.object) after.set(change.id, withKnownBox(change.object, objects.get(change.id)));
    else after.delete(change.id);
  }
  return after;
}

export const toggled = <Item>(set: ReadonlySet<Item>, item: Item): ReadonlySet<Item> => {
  const after = new Set(set);
  if (!after.delete(item)) after.add(item);
  return after;
};
