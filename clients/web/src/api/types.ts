// SPDX-License-Identifier: BSD-3-Clause
// What the server sends, as far as the viewer reads it. The names of the API's fields are in this folder alone.

export interface Vector3 {
  readonly x: number;
  readonly y: number;
  readonly z: number;
}
export interface Quaternion extends Vector3 {
  readonly w: number;
}
/** p_map = rotation * p_object + translation_m. */
export interface Pose {
  readonly translation_m: Vector3;
  readonly rotation: Quaternion;
}

export type Kind = "thing" | "stuff" | "unknown";

/** One object or background class, in the words of the viewer. */
export interface MapObject {
  readonly id: string;
  readonly name: string;
  readonly label: string;
  readonly kind: Kind;
  readonly className: string;
  readonly classId: number;
  readonly classConfidence: number;
  readonly instanceConfidence: number;
  readonly pose: Pose;
  readonly sphere: { readonly center: Vector3; readonly radius_m: number } | null;
  /** Upright, in the map frame: middle, turn about the vertical, sides. */
  readonly box: { readonly pose: Pose; readonly size_m: Vector3 } | null;
  /** Its outline from above, in the map frame, counterclockwise: x and y in turn. */
  readonly footprint_m: readonly number[];
  readonly isPresent: boolean;
  readonly isLocked: boolean;
  readonly isConfirmed: boolean;
  readonly numFrames: number;
  readonly lastSeen_ns: bigint;
  readonly revision: number;
  readonly etag: string;
}

/** Upright along the axes of the map frame. */
export interface AxisBox {
  readonly min_m: Vector3;
  readonly max_m: Vector3;
}

/** Where mapping takes nothing any more. */
export interface IgnoredRegion {
  readonly name: string;
  /** Around the ball, of one that is a ball. */
  readonly box: AxisBox;
}

export interface LabelClass {
  readonly name: string;
  readonly kind: Kind;
}

export interface MapInfo {
  readonly name: string;
  readonly id: string;
  readonly displayName: string;
  readonly revision: number;
  readonly numFrames: number;
  readonly numObjects: number;
  readonly historyId: string;
  readonly classes: readonly LabelClass[];
}

/** A map at a revision; null: as it is now. */
export interface MapState {
  readonly name: string;
  readonly at: number | null;
}

/** A state that the server still has. */
export interface KeptRevision {
  readonly revision: number;
  readonly time_ms: number;
}

export interface LoggedEdit {
  readonly name: string;
  readonly revision: number;
  readonly time: string;
  readonly author: string;
  readonly what: string;
  readonly objects: readonly string[];
  readonly isUndone: boolean;
  /** Of an undo, or of doing again: what it takes back, or makes again, by name. */
  readonly targets: readonly string[];
}

/** What became of an object. */
export interface ObjectChange {
  readonly id: string;
  readonly kind: "created" | "changed" | "removed";
  readonly isGeometry: boolean;
  readonly object: MapObject | null;
}

/** A floor plan of a band of heights: a byte a cell, x fastest. */
export interface Slice {
  readonly width: number;
  readonly height: number;
  readonly resolution_m: number;
  readonly origin_m: Vector3;
  readonly cells: Uint8Array;
}

export const sliceCells = { free: 0, occupied: 100, unknown: 255 } as const;

/** What is at a point of a surface, and the nearest surface of another object. */
export interface SurfacePoint {
  readonly distance_m: number;
  readonly nearest: Vector3 | null;
  readonly neighbour: string | null;
  readonly ownerId: string | null;
  readonly classConfidence: number;
}

/** How far an object's surface is from a place. */
export interface NearObject {
  readonly id: string;
  readonly label: string;
  readonly kind: Kind;
  readonly distance_m: number;
}

/** What a ray meets. */
export interface RayAnswer {
  /** Null: nothing, as far as it was followed. */
  readonly point_m: Vector3 | null;
  readonly distance_m: number;
  /** Up to what it meets, or to where nobody has looked. */
  readonly free_m: number;
  readonly isSeen: boolean;
  readonly id: string | null;
}

/** An object that is touched; `isUnder`: by its upper side, as a floor is by what stands on it. */
export interface Touch {
  readonly id: string;
  readonly isUnder: boolean;
}

/** What a robot meets on a path. */
export interface PathAnswer {
  readonly revision: number;
  readonly isFree: boolean;
  /** The first; `fraction`: share of the way from a waypoint to the next. Without an id: what nobody has seen. */
  readonly contact: {
    readonly waypoint: number;
    readonly fraction: number;
    readonly id: string | null;
    readonly point_m: Vector3;
  } | null;
  /** How near it comes to a surface, and whose. */
  readonly clearance: { readonly distance_m: number; readonly id: string | null } | null;
}

/** What an edit did, or would do. */
export interface EditOutcome {
  readonly revision: number;
  readonly created: readonly string[];
  readonly removed: readonly string[];
  readonly numVoxels: number;
}

/** How a thing is taken apart: each part that hangs together, or what is beyond a plane. */
export type Cut = { readonly by: "parts" } | { readonly by: "plane"; readonly point_m: Vector3; readonly normal: Vector3 };

/** What feeds the map: where its sensor is, and was. */
export interface Robot {
  readonly name: string;
  readonly isFeeding: boolean;
  readonly pose: Pose;
  readonly path_m: readonly Vector3[];
}
