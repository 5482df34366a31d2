// SPDX-License-Identifier: BSD-3-Clause
import { DataTexture, DoubleSide, Mesh, MeshBasicMaterial, NearestFilter, PlaneGeometry, SRGBColorSpace } from "three";
import { sliceCells, type Slice } from "../api/types";

type Rgba = readonly [number, number, number, number];
const occupied: Rgba = [240, 243, 248, 235];
const free: Rgba = [96, 170, 150, 110];
const unknown: Rgba = [242, 184, 75, 60];

/** A floor plan in the scene, at its height. */
export class SlicePlane {
  readonly mesh = new Mesh(
    new PlaneGeometry(1, 1),
    new MeshBasicMaterial({ transparent: true, side: DoubleSide, depthWrite: false, toneMapped: false }),
  );

  show(slice: Slice, z_m: number): void {
    const { width, height, resolution_m, origin_m } = slice;
    const pixels = new Uint8Array(4 * width * height);
    slice.cells.forEach((cell, i) =>
      pixels.set(cell === sliceCells.occupied ? occupied : cell === sliceCells.free ? free : unknown, 4 * i),
    );
    const texture = new DataTexture(pixels, width, height);
    texture.colorSpace = SRGBColorSpace;
    texture.magFilter = NearestFilter;
    texture.needsUpdate = true;
    this.mesh.material.map?.dispose();
    this.mesh.material.map = texture;
    this.mesh.material.needsUpdate = true;
    this.mesh.scale.set(width * resolution_m, height * resolution_m, 1);
    this.mesh.position.set(origin_m.x + this.mesh.scale.x / 2, origin_m.y + this.mesh.scale.y / 2, z_m);
  }
}
