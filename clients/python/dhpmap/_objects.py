# SPDX-License-Identifier: BSD-3-Clause
"""Objects of a map, as they were at one revision."""
from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from dhpmap._arrays import frozen
from dhpmap._errors import bad_argument
from dhpmap._pose import read_pose, read_vector
from dhpmap._shapes import Box, OrientedBox, read_box, read_oriented_box
from dhpmap.v1 import search_pb2, types_pb2

KINDS = {0: "unknown", 1: "thing", 2: "stuff"}


@dataclass(frozen=True, slots=True)
class Ref:
    """Which object: what an answer names, and what may stand wherever an object is asked for.

    Attributes:
        id: never reused; 0 holds the geometry of unknown objects, -1: nothing, or unseen space.
    """

    id: int
    class_name: str = ""

    def __str__(self) -> str:
        if self.id < 0:
            return "unseen space"
        return f"{self.class_name or 'unknown object'} {self.id}"


@dataclass(frozen=True, eq=False, slots=True, kw_only=True, repr=False)
class Object:
    """A thing, or the background of one class. Arrays are read-only; places are in the map frame, in metres.

    Attributes:
        id: never reused; 0 holds the geometry of unknown objects.
        name: for people; follows the class until somebody sets it.
        kind: "thing", "stuff" or "unknown".
        class_id: -1: it has no class.
        box: smallest upright box around its surface, turned about z; None: it has none.
        T_map_object: (4, 4).
        footprint_m: (N, 2) convex outline from above, counterclockwise.
        support_height_m: z of its upper side, where things may stand.
        center_m: (3,) of the sphere around its voxels.
        class_confidence: share of its observations that said this class.
        instance_confidence: share of its observations that are its own.
        is_present: False: sensors have looked through most of it, so it is left out of queries.
        is_active: takes new observations; False: settled.
        is_confirmed: seen again after it was new.
        is_locked: mapping leaves it alone.
        num_frames: that showed it.
        first_seen_ns, last_seen_ns: stamps of the sensor's clock; None: it was never seen.
        revision: that last changed it.
        map_name: maps/{map}.
        distance_m: of a search with `near`: from there to its surface; else NaN.
        nearest_point_m: (3,) of a search with `near`: on its surface; else NaN.
        bounds: of a search: around its surface, in the frame that was asked in; else None.
    """

    id: int
    name: str
    kind: str
    class_name: str
    class_id: int
    box: OrientedBox | None
    T_map_object: NDArray[np.float64]
    footprint_m: NDArray[np.float64]
    support_height_m: float | None
    center_m: NDArray[np.float64]
    radius_m: float
    class_confidence: float
    instance_confidence: float
    is_present: bool
    is_active: bool
    is_confirmed: bool
    is_locked: bool
    num_frames: int
    first_seen_ns: int | None
    last_seen_ns: int | None
    revision: int
    etag: str
    map_name: str

    distance_m: float = float("nan")
    nearest_point_m: NDArray[np.float64] = field(default_factory=lambda: frozen(np.full(3, np.nan)))
    bounds: Box | None = None

    def __str__(self) -> str:
        return self.name or f"{self.class_name or 'unknown'} {self.id}"

    def __repr__(self) -> str:
        x, y, z = (self.box.center_m if self.box else self.center_m).round(2).tolist()
        size = " x ".join(f"{side:.2f}" for side in self.box.size_m) + " m, " if self.box else ""
        return f"<Object {self.id}: {self}, {size}at ({x}, {y}, {z}), revision {self.revision}>"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Object) and self._key() == other._key()

    def _key(self) -> tuple[str, int, str]:
        return self.map_name, self.id, self.etag

    def __hash__(self) -> int:
        return hash(self._key())

    def _repr_html_(self) -> str:
        from dhpmap._show import object_html
        return object_html(self)


ObjectLike = Object | Ref | int


def id_of(thing: ObjectLike, map_name: str = "") -> int:
    """Raises InvalidArgument for what is no object, or one of another map."""
    if isinstance(thing, Object):
        if map_name and thing.map_name != map_name:
            raise bad_argument("object", f"{thing} is of {thing.map_name}, not of {map_name}")
        return thing.id
    if isinstance(thing, Ref):
        return thing.id
    if isinstance(thing, (int, np.integer)) and not isinstance(thing, bool):
        return int(thing)
    raise bad_argument("object", f"wanted an object or its id, got a {type(thing).__name__}: {thing!r}")


def submap_name(map_name: str, thing: ObjectLike) -> str:
    number = id_of(thing, map_name)
    if number < 0:
        raise bad_argument("object", f"{number} is no object")
    return f"{map_name}/submaps/{number}"


def id_of_name(name: str) -> int:
    return int(name.rpartition("/")[2])


def read_object(message: types_pb2.Submap) -> Object:
    box = read_oriented_box(message.oriented_box) if message.HasField("oriented_box") else None
    outline = np.array(message.footprint.xy_m, dtype=np.float64).reshape(-1, 2)
    return Object(
        id=message.instance_id, name=message.display_name, kind=KINDS.get(message.kind, "unknown"),
        class_name=message.class_name, class_id=message.class_id if message.HasField("class_id") else -1, box=box,
        T_map_object=read_pose(message.map_from_submap), footprint_m=frozen(outline),
        support_height_m=message.support_height_m if message.HasField("support_height_m") else None,
        center_m=read_vector(message.bounding_sphere.center_m), radius_m=message.bounding_sphere.radius_m,
        class_confidence=message.class_confidence, instance_confidence=message.instance_confidence,
        is_present=message.presence != types_pb2.Submap.ABSENT, is_active=message.activity == types_pb2.Submap.ACTIVE,
        is_confirmed=message.confirmed, is_locked=message.locked, num_frames=message.num_frames_observed,
        first_seen_ns=message.first_observed_stamp_ns if message.HasField("first_observed_stamp_ns") else None,
        last_seen_ns=message.last_observed_stamp_ns if message.HasField("last_observed_stamp_ns") else None,
        revision=message.revision, etag=message.etag, map_name=message.name.partition("/submaps/")[0])


def read_match(message: search_pb2.SubmapMatch) -> Object:
    """An object that a search has found, with how far it is."""
    found = read_object(message.submap)
    bounds = read_box(message.box) if message.HasField("box") else None
    if not message.HasField("nearest_point_m"):
        return replace(found, bounds=bounds)
    return replace(found, bounds=bounds, distance_m=message.distance_m,
                   nearest_point_m=read_vector(message.nearest_point_m))
