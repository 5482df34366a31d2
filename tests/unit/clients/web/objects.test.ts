// SPDX-License-Identifier: BSD-3-Clause
import assert from "node:assert/strict";
import { test } from "node:test";
import { readChanges, readObject } from "../../../../clients/web/src/api/read";
import { groupByClass, isFound, isShown, toggled, withChanges } from "../../../../clients/web/src/state/objects";

const sphere = { center_m: { x: 0, y: 0, z: 0 }, radius_m: 1 };
const object = (id: number, class_name: string, more: object = {}) =>
  readObject({
    name: `maps/m/submaps/${id}`,
    display_name: `${class_name} ${id}`,
    class_name,
    kind: "THING",
    bounding_sphere: sphere,
    ...more,
  });
const view = { hiddenClasses: new Set<string>(), hiddenObjects: new Set<string>(), showsGone: false };

test("things come before backgrounds, and names in natural order", () => {
  const objects = [object(10, "chair"), object(1, "wall", { kind: "STUFF" }), object(2, "chair"), object(3, "bed")];
  const groups = groupByClass(objects, "", false);
  assert.deepEqual(
    groups.map((group) => group.className),
    ["bed", "chair", "wall"],
  );
  assert.deepEqual(
    groups[1]?.objects.map((each) => each.id),
    ["2", "10"],
  );
});

test("every word of a search must be found", () => {
  assert.ok(isFound(object(7, "coffee table"), "table #7"));
  assert.ok(!isFound(object(7, "coffee table"), "table chair"));
  assert.ok(isFound(object(7, "coffee table"), ""));
});

test("what is gone is shown and listed only if asked for", () => {
  const gone = object(4, "box", { presence: "ABSENT" });
  assert.ok(!isShown(gone, view));
  assert.ok(isShown(gone, { ...view, showsGone: true }));
  assert.equal(groupByClass([gone], "", false).length, 0);
});

test("a class and an object can be hidden", () => {
  assert.ok(!isShown(object(1, "box"), { ...view, hiddenClasses: toggled(view.hiddenClasses, "box") }));
  assert.ok(!isShown(object(1, "box"), { ...view, hiddenObjects: new Set(["1"]) }));
});

test("an event replaces changed objects and removes deleted ones", () => {
  const { revision, changes } = readChanges({
    position: "h-9",
    change: {
      last_revision: "9",
      submaps: [
        { kind: "CHANGED", parts: ["POSE"], submap: { name: "maps/m/submaps/1", display_name: "moved" } },
        { kind: "CREATED", submap: { name: "maps/m/submaps/3" } },
        { kind: "MERGED", submap: { name: "maps/m/submaps/2" }, merged_into: "maps/m/submaps/1" },
      ],
    },
  });
  assert.equal(revision, 9);
  assert.deepEqual(
    changes.map((change) => [change.kind, change.isGeometry]),
    [
      ["changed", false],
      ["created", true],
      ["removed", false],
    ],
  );
  const after = withChanges(
    new Map([
      ["1", object(1, "box")],
      ["2", object(2, "box")],
    ]),
    changes,
  );
  assert.deepEqual([...after.keys()], ["1", "3"]);
  assert.equal(after.get("1")?.label, "moved");
});
