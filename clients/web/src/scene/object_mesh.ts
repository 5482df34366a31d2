// SPDX-License-Identifier: BSD-3-Clause
import { BufferAttribute, BufferGeometry, Matrix4, Mesh, Quaternion, ShaderMaterial, Sphere, Vector3 } from "three";
import { MeshBVH, acceleratedRaycast } from "three-mesh-bvh";
import type { Surface } from "../api/glb";
import type { Pose } from "../api/types";
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

/** One object in the scene: owns its surface and what rays are tested with, and frees both. */
export class ObjectMesh {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  readonly numTriangles: number;
  readonly bytes: number;
  private readonly fromSteps: Matrix4;

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
      if (!geometry.boundsTree) geometry.boundsTree = new MeshBVH(geometry);
      acceleratedRaycast.call(this.mesh, raycaster, hits);
    };
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

  dispose(): void {
    this.mesh.removeFromParent();
    delete this.mesh.geometry.boundsTree;
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
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
