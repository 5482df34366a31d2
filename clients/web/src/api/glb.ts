// SPDX-License-Identifier: BSD-3-Clause
// Reads the GLB that this server writes (mapping/io/glb.h): a node an object, one mesh below it.

/** One object's surface. Positions are steps of 1/65535 of `scale_m`, from `offset_m` on, in the object's frame. */
export interface Surface {
  readonly id: string;
  readonly offset_m: readonly [number, number, number];
  readonly scale_m: number;
  readonly positions: Uint16Array; // 4 a vertex, the last unused
  readonly normals: Int8Array; // likewise
  readonly colors: Uint16Array; // likewise; linear
  readonly indices: Uint16Array | Uint32Array;
  readonly bytes: number;
}

interface GltfNode {
  readonly mesh?: number;
  readonly children?: readonly number[];
  readonly translation?: readonly [number, number, number];
  readonly scale?: readonly number[];
  readonly extras?: { readonly instance_id?: number };
}
interface Gltf {
  readonly scenes: readonly { readonly nodes?: readonly number[] }[];
  readonly nodes?: readonly GltfNode[];
  readonly meshes?: readonly {
    readonly primitives: readonly { readonly attributes: { readonly POSITION: number }; readonly indices: number }[];
  }[];
  readonly accessors?: readonly {
    readonly bufferView: number;
    readonly componentType: number;
    readonly count: number;
  }[];
  readonly bufferViews?: readonly { readonly byteOffset: number; readonly byteStride?: number }[];
}

const magic = 0x46546c67;
const shortIndices = 5123;

/** Throws an Error for what is no such file. */
export function readGlb(file: ArrayBuffer): readonly Surface[] {
  const head = new DataView(file);
  if (file.byteLength < 20 || head.getUint32(0, true) !== magic) throw new Error("the server sent no GLB");
  const jsonBytes = head.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(new Uint8Array(file, 20, jsonBytes))) as Gltf;
  const bin = 20 + jsonBytes + 8;
  const surfaces: Surface[] = [];
  for (const number of json.scenes[0]?.nodes ?? []) {
    const node = json.nodes?.[number];
    if (node) surfaces.push(readSurface(file, bin, json, node));
  }
  return surfaces;
}

function readSurface(file: ArrayBuffer, bin: number, json: Gltf, node: GltfNode): Surface {
  const id = String(node.extras?.instance_id ?? "");
  const child = json.nodes?.[node.children?.[0] ?? -1];
  const primitive = json.meshes?.[child?.mesh ?? -1]?.primitives[0];
  const vertices = json.accessors?.[primitive?.attributes.POSITION ?? -1];
  const triangles = json.accessors?.[primitive?.indices ?? -1];
  const view = json.bufferViews?.[vertices?.bufferView ?? -1];
  const indexView = json.bufferViews?.[triangles?.bufferView ?? -1];
  if (!child || !vertices || !triangles || !view || !indexView) {
    const none = new Uint16Array(0);
    return {
      id,
      offset_m: [0, 0, 0],
      scale_m: 1,
      positions: none,
      normals: new Int8Array(0),
      colors: none,
      indices: none,
      bytes: 0,
    };
  }
  const at = bin + indexView.byteOffset;
  const indices =
    triangles.componentType === shortIndices
      ? new Uint16Array(file.slice(at, at + 2 * triangles.count))
      : new Uint32Array(file.slice(at, at + 4 * triangles.count));
  const parts = apart(file, bin + view.byteOffset, view.byteStride ?? 20, vertices.count);
  return {
    id,
    offset_m: child.translation ?? [0, 0, 0],
    scale_m: child.scale?.[0] ?? 1,
    ...parts,
    indices,
    bytes: 20 * vertices.count + indices.byteLength,
  };
}

/** The interleaved vertices as lists that the GPU takes, four values each. */
function apart(file: ArrayBuffer, begin: number, stride: number, count: number) {
  const from16 = new Uint16Array(file, begin, (stride / 2) * count);
  const from8 = new Int8Array(file, begin, stride * count);
  const positions = new Uint16Array(4 * count);
  const normals = new Int8Array(4 * count);
  const colors = new Uint16Array(4 * count);
  for (let i = 0; i < count; ++i) {
    const at16 = (i * stride) / 2;
    const at8 = i * stride + 8;
    for (let k = 0; k < 3; ++k) {
      positions[4 * i + k] = from16[at16 + k] ?? 0;
      normals[4 * i + k] = from8[at8 + k] ?? 0;
      colors[4 * i + k] = from16[at16 + 6 + k] ?? 0;
    }
  }
  return { positions, normals, colors };
}
