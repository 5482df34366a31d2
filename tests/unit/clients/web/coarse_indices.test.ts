// SPDX-License-Identifier: BSD-3-Clause
import assert from "node:assert/strict";
import { test } from "node:test";
import { coarseIndices } from "../../../../clients/web/src/scene/coarse_indices";

const side = 41;
const step = 1000;

/** A square of side x side vertices, a step between two, two triangles a cell of them. */
function newSquare() {
  const positions = new Uint16Array(4 * side * side);
  const indices: number[] = [];
  for (let y = 0; y < side; ++y) {
    for (let x = 0; x < side; ++x) {
      positions.set([x * step, y * step, 500, 0], 4 * (y * side + x));
      if (x + 1 === side || y + 1 === side) continue;
      const a = y * side + x;
      indices.push(a, a + 1, a + side, a + 1, a + side + 1, a + side);
    }
  }
  return { positions, indices: new Uint16Array(indices) };
}

function areaOf(positions: Uint16Array, indices: ArrayLike<number>): number {
  let sum = 0;
  const at = (vertex: number, k: number) => positions[4 * vertex + k] ?? 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [indices[i]!, indices[i + 1]!, indices[i + 2]!];
    sum += ((at(b, 0) - at(a, 0)) * (at(c, 1) - at(a, 1)) - (at(c, 0) - at(a, 0)) * (at(b, 1) - at(a, 1))) / 2;
  }
  return sum;
}

test("a flat square of cells of four steps has a sixteenth of the triangles, faces up and has no holes", () => {
  const { positions, indices } = newSquare();
  const coarse = coarseIndices(positions, indices, 4 * step);
  assert.equal(coarse.length / 3, 2 * 10 * 10);
  // Of each cell of 4 x 4 vertices one is left; from the first to the last of them all is covered, once.
  const used = [...coarse].map((vertex) => positions[4 * vertex] ?? 0);
  const width = Math.max(...used) - Math.min(...used);
  const ys = [...coarse].map((vertex) => positions[4 * vertex + 1] ?? 0);
  assert.equal(areaOf(positions, coarse), width * (Math.max(...ys) - Math.min(...ys)));
  assert.ok(coarse instanceof Uint16Array);
});

test("cells of less than a step leave every triangle, and what is within one cell goes", () => {
  const { positions, indices } = newSquare();
  assert.deepEqual(coarseIndices(positions, indices, step / 2), indices);
  assert.equal(coarseIndices(positions, indices, 65536).length, 0);
});

test("vertices are told apart by their cell in space, whatever their hash is", () => {
  // A tower of 3,000 triangles far from each other: the cells are many, and none is another's.
  const random = (() => {
    let seed = 7;
    return () => (seed = (seed * 16807) % 2147483647) % 65536;
  })();
  const positions = new Uint16Array(Array.from({ length: 4 * 9000 }, random));
  const indices = new Uint32Array(Array.from({ length: 9000 }, (_, i) => i));
  const cell = 700;
  const cellOf = (vertex: number) =>
    [0, 1, 2].map((k) => Math.floor((positions[4 * vertex + k] ?? 0) / cell)).join(" ");
  const coarse = coarseIndices(positions, indices, cell);
  let at = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const cells = [0, 1, 2].map((k) => cellOf(indices[i + k] ?? 0));
    if (new Set(cells).size < 3) continue;
    assert.deepEqual([0, 1, 2].map((k) => cellOf(coarse[at + k] ?? 0)), cells);
    at += 3;
  }
  assert.equal(coarse.length, at);
});
