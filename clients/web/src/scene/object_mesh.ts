// SPDX-License-Identifier: BSD-3-Clause
import { BufferAttribute, BufferGeometry, Matrix4, Mesh, Quaternion, ShaderMaterial, Sphere, Vector3 } from "three";
import { MeshBVH, acceleratedRaycast } from "three-mesh-bvh";
import type { Surface } from "../api/glb";
import type { Pose } from "../api/types";
import { coarseIndices } from "./coarse_indices";
import type { Rgb } from "./colours";
import { newSurfaceMaterial } from "./surface_material";

export const matrixOfPose = (pose: Pose): Matrix4 => {
  const { translation_m: t, rotation: r } = pose;
  return new Matrix4().compose(
    new Vector3(t.x, t.y, t.z),
    new Quaternion(r.x, r.y, r.z, r.w).normalize(),
    new Vector3(1, 1, 1),
  );
};

/** Sides of the cells of the coarser levels, in edges of triangles. */
const cellsOfLevels = [0, 2.5, 5, 10];
export const numLevels = cellsOfLevels.length;

/** One object in the scene: owns its surface, coarser ones of it and what rays are tested with, and frees them. */
export class ObjectMesh {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  readonly numTriangles: number;
  readonly bytes: number;
  private readonly fromSteps: Matrix4;
  private readonly edge: number; // of a triangle, in steps
  private readonly levels: BufferGeometry[];

  constructor(
    surface: Surface,
    readonly id: string,
  ) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(surface.positions, 4, true));
    geometry.setAttribute("normal", new BufferAttribute(surface.normals, 4, true));
    geometry.setAttribute("color", new BufferAttribute(surface.colors, 4, true));
    geometry.setIndex(new BufferAttribute(surface.indices, 1));
    geometry.boundingSphere = boundsOf(surface.positions);
    this.mesh = new Mesh(geometry, newSurfaceMaterial());
    this.mesh.name = id;
    this.mesh.matrixAutoUpdate = false;
    this.mesh.raycast = (raycaster, hits) => {
      const sphere = geometry.boundingSphere!.clone().applyMatrix4(this.mesh.matrixWorld);
      if (!raycaster.ray.intersectsSphere(sphere)) return; // a tree is made of what is pointed at
      if (!geometry.boundsTree) geometry.boundsTree = new MeshBVH(geometry);
      acceleratedRaycast.call(this.mesh, raycaster, hits);
    };
    this.levels = [geometry];
    this.edge = edgeOf(surface.positions, surface.indices);
    const s = surface.scale_m;
    this.fromSteps = new Matrix4().makeTranslation(...surface.offset_m).multiply(new Matrix4().makeScale(s, s, s));
    this.numTriangles = surface.indices.length / 3;
    this.bytes = surface.bytes;
  }

  /** A move is this alone: nothing is fetched, nothing is uploaded. */
  setPose(pose: Pose): void {
    this.mesh.matrix.copy(matrixOfPose(pose)).multiply(this.fromSteps);
    this.mesh.matrixWorldNeedsUpdate = true;
  }

  /** `flat`: in place of the sensor's colours. `ghost`: 0 as it is, 1 hardly there. */
  setLook(flat: Rgb | null, ghost: number): void {
    const { uniforms } = this.mesh.material;
    uniforms["flatShare"]!.value = flat ? 1 : 0;
    if (flat) (uniforms["flatColor"]!.value as Vector3).fromArray(flat);
    uniforms["ghost"]!.value = ghost;
  }

  /** How far a level is from the surface, at most, in metres. 0 is the surface itself. */
  errorOf_m(level: number): number {
    return (cellsOfLevels[level] ?? 0) * this.edge * this.fromSteps.getMaxScaleOnAxis();
  }

  /** About; exact once the level has been drawn. */
  trianglesOf(level: number): number {
    return this.levels[level] ? this.levels[level].index!.count / 3 : this.numTriangles / 4 ** level;
  }

  /** Made when it is first asked for. Vertices are shared. */
  geometryOf(level: number): BufferGeometry {
    const held = this.levels[level];
    if (held) return held;
    const full = this.levels[0]!;
    const indices = full.index!.array as Uint16Array | Uint32Array;
    const coarse = new BufferGeometry();
    for (const [name, attribute] of Object.entries(full.attributes)) coarse.setAttribute(name, attribute);
    const cell = (cellsOfLevels[level] ?? 0) * this.edge;
    coarse.setIndex(
      new BufferAttribute(coarseIndices(full.attributes["position"]!.array as Uint16Array, indices, cell), 1),
    );
    coarse.boundingSphere = full.boundingSphere;
    return (this.levels[level] = coarse);
  }

  dispose(): void {
    this.mesh.removeFromParent();
    delete this.mesh.geometry.boundsTree;
    for (const geometry of this.levels) geometry?.dispose();
    this.mesh.material.dispose();
  }
}

/** The mean edge of some of the triangles. */
function edgeOf(positions: Uint16Array, indices: Uint16Array | Uint32Array): number {
  const mostSampled = 200;
  const stride = 3 * Math.max(1, Math.floor(indices.length / 3 / mostSampled));
  let sum = 0;
  let num = 0;
  for (let i = 0; i + 1 < indices.length; i += stride) {
    const [a, b] = [4 * (indices[i] ?? 0), 4 * (indices[i + 1] ?? 0)];
    sum += Math.hypot(...[0, 1, 2].map((k) => (positions[a + k] ?? 0) - (positions[b + k] ?? 0)));
    ++num;
  }
  return num === 0 ? 1 : sum / num;
}

/** Around the box of the steps that are used; the box of all steps would be seen where nothing is. */
function boundsOf(positions: Uint16Array): Sphere {
  const max = [0, 0, 0];
  for (let i = 0; i < positions.length; i += 4) {
    for (let k = 0; k < 3; ++k) max[k] = Math.max(max[k] ?? 0, positions[i + k] ?? 0);
  }
  const half = new Vector3(max[0], max[1], max[2]).multiplyScalar(0.5 / 65535);
  return new Sphere(half, half.length());
}
