// SPDX-License-Identifier: BSD-3-Clause
// A coarser surface over the same vertices: those of a cell become one (Rossignac & Borrel, 1993).

const none = -1;

/** Of the vertices of each cell of side `cell`, in steps of the positions, the one nearest to their middle. */
function representatives(positions: Uint16Array, cell: number): Int32Array {
  const count = positions.length / 4;
  const cellOf = new Int32Array(count);
  const bits = Math.max(4, Math.ceil(Math.log2(2 * count + 1)));
  const table = new Int32Array(2 ** bits).fill(none); // the first vertex of a cell, by a hash of it
  const first: number[] = [];
  const side = Math.ceil(65536 / cell);
  const keyOf = (vertex: number) => {
    const [x, y, z] = [0, 1, 2].map((k) => Math.floor((positions[4 * vertex + k] ?? 0) / cell)) as [number, number, number];
    return (x * side + y) * side + z;
  };
  const keys = new Float64Array(count);
  for (let i = 0; i < count; ++i) {
    const key = (keys[i] = keyOf(i));
    let at = Math.imul(key ^ Math.floor(key / 4294967296), 0x9e3779b1) >>> (32 - bits);
    for (;;) {
      const held = table[at] ?? none;
      if (held === none) {
        table[at] = i;
        cellOf[i] = first.push(i) - 1;
        break;
      }
      if (keys[held] === key) {
        cellOf[i] = cellOf[held] ?? 0;
        break;
      }
      at = (at + 1) & (table.length - 1);
    }
  }
  return nearestToMiddle(positions, cellOf, first.length);
}

function nearestToMiddle(positions: Uint16Array, cellOf: Int32Array, numCells: number): Int32Array {
  const sums = new Float64Array(4 * numCells);
  for (let i = 0; i < cellOf.length; ++i) {
    const to = 4 * (cellOf[i] ?? 0);
    for (let k = 0; k < 3; ++k) sums[to + k] = (sums[to + k] ?? 0) + (positions[4 * i + k] ?? 0);
    sums[to + 3] = (sums[to + 3] ?? 0) + 1;
  }
  const nearest = new Int32Array(numCells).fill(none);
  const best = new Float64Array(numCells).fill(Infinity);
  for (let i = 0; i < cellOf.length; ++i) {
    const cell = cellOf[i] ?? 0;
    let distance2 = 0;
    for (let k = 0; k < 3; ++k)
      distance2 += ((positions[4 * i + k] ?? 0) - (sums[4 * cell + k] ?? 0) / (sums[4 * cell + 3] ?? 1)) ** 2;
    if (distance2 >= (best[cell] ?? 0)) continue;
    best[cell] = distance2;
    nearest[cell] = i;
  }
  return cellOf.map((cell) => nearest[cell] ?? none);
}

/** The triangles whose corners are in three cells of side `cell`, which is in steps of the positions, 1 and more. */
export function coarseIndices<Indices extends Uint16Array | Uint32Array>(
  positions: Uint16Array,
  indices: Indices,
  cell: number,
): Indices {
  const ofVertex = representatives(positions, Math.max(1, cell));
  const coarse = indices.slice() as Indices;
  let size = 0;
  for (let i = 0; i + 2 < indices.length; i += 3) {
    const a = ofVertex[indices[i] ?? 0] ?? 0;
    const b = ofVertex[indices[i + 1] ?? 0] ?? 0;
    const c = ofVertex[indices[i + 2] ?? 0] ?? 0;
    if (a === b || b === c || c === a) continue;
    coarse[size] = a;
    coarse[size + 1] = b;
    coarse[size + 2] = c;
    size += 3;
  }
  return coarse.slice(0, size) as Indices;
}
