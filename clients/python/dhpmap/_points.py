# SPDX-License-Identifier: BSD-3-Clause
"""What is at a point; what a ray meets."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dhpmap._arrays import rows
from dhpmap._columns import CLAMPED, UNKNOWN, ask_packed, is_status
from dhpmap._errors import bad_argument
from dhpmap._options import QueryOptions, options_message
from dhpmap._source import Source
from dhpmap._wire import floats_field
from dhpmap.v1 import query_service_pb2 as pb2


@dataclass(frozen=True, eq=False, slots=True)
class Points:
    """Columns in the shape of the points that were asked, (...) or (..., 3).

    Attributes:
        near_surface: (...) a surface is near; where none is, object and class say nothing.
        free: (...) sensors have looked through; neither free nor near a surface: unknown.
        object_id: (...) 0: unknown object.
        class_id: (...) -1: it has no class.
        tsdf_m: (...) truncated signed distance of its voxel; NaN where no surface is near.
        weight: (...) of its voxel's observations.
        rgb: (..., 3).
        class_confidence: (...) 0 to 1.
        instance_confidence: (...) 0 to 1.
    """

    revision: int
    near_surface: NDArray[np.bool_]
    free: NDArray[np.bool_]
    object_id: NDArray[np.int64]
    class_id: NDArray[np.int64]
    tsdf_m: NDArray[np.float32]
    weight: NDArray[np.float32]
    rgb: NDArray[np.uint8]
    class_confidence: NDArray[np.float32]
    instance_confidence: NDArray[np.float32]

    @property
    def known(self) -> NDArray[np.bool_]:
        """(...) free, or near a surface."""
        known: NDArray[np.bool_] = self.free | self.near_surface
        return known


@dataclass(frozen=True, eq=False, slots=True)
class Rays:
    """Columns in the shape of the directions that were asked, (...) or (..., 3).

    Attributes:
        distance_m: (...) to what it meets; nothing: max_distance_m.
        free_m: (...) so far it goes before it meets something or enters the unseen.
        point_m: (..., 3) where it meets it; nothing: NaN.
        normal: (..., 3) unit, out of the surface's front; nothing: NaN.
        object_id: (...) whose surface; 0: unknown object, -1: nothing met.
        class_id: (...) -1: it has no class.
        status: (...) 1 ok, 2 clamped, 3 unknown.
    """

    revision: int
    distance_m: NDArray[np.float32]
    free_m: NDArray[np.float32]
    point_m: NDArray[np.float32]
    normal: NDArray[np.float32]
    object_id: NDArray[np.int64]
    class_id: NDArray[np.int64]
    status: NDArray[np.uint8]

    @property
    def hit(self) -> NDArray[np.bool_]:
        """(...) whether it meets something within max_distance_m, though it may have gone through the unseen."""
        hit: NDArray[np.bool_] = self.object_id >= 0
        return hit

    @property
    def known(self) -> NDArray[np.bool_]:
        """(...) whether all on its way has been seen."""
        return ~is_status(self.status, UNKNOWN)

    @property
    def clamped(self) -> NDArray[np.bool_]:
        """(...) whether it meets nothing, all known."""
        return is_status(self.status, CLAMPED)


def query_points(source: Source, points_m: ArrayLike, options: QueryOptions, deadline_s: float | None = None
                 ) -> Points:
    points, shape = rows("points_m", points_m, 3, "x, y, z in metres")
    head = pb2.QueryPointsRequest(map=source.map_name, packed=True,
                                  options=options_message(source.map_name, options))

    def request(part: slice, revision: int) -> bytes:
        head.read_revision = revision
        return head.SerializeToString() + floats_field(head.DESCRIPTOR, "packed_points_m", points[part])

    packed = ask_packed(source, pb2.QueryPointsRequest, pb2.QueryPointsResponse, len(points), request,
                        deadline_s=deadline_s)
    return Points(packed.revision, packed.bools("near_surface", shape), packed.bools("free", shape),
                  packed.ints("instance_id", shape), packed.ints("class_id", shape), packed.floats("tsdf_m", shape),
                  packed.floats("weight", shape), packed.octets("rgb", (*shape, 3)),
                  packed.floats("class_confidence", shape), packed.floats("instance_confidence", shape))


def cast_rays(source: Source, origins_m: ArrayLike, directions: ArrayLike, options: QueryOptions,
              deadline_s: float | None = None) -> Rays:
    starts, starts_shape = rows("origins_m", origins_m, 3, "x, y, z in metres")
    ways, shape = rows("directions", directions, 3, "x, y, z of any length")
    if len(starts) != 1 and starts_shape != shape:
        raise bad_argument("origins_m", f"wanted one origin, or one a direction, {(*shape, 3)}, "
                                        f"got {(*starts_shape, 3)}")
    head = pb2.CastRaysRequest(map=source.map_name, packed=True, options=options_message(source.map_name, options))

    def request(part: slice, revision: int) -> bytes:
        head.read_revision = revision
        return (head.SerializeToString()
                + floats_field(head.DESCRIPTOR, "packed_origins_m", starts if len(starts) == 1 else starts[part])
                + floats_field(head.DESCRIPTOR, "packed_directions", ways[part]))

    packed = ask_packed(source, pb2.CastRaysRequest, pb2.CastRaysResponse, len(ways), request, deadline_s=deadline_s)
    return Rays(packed.revision, packed.floats("distance_m", shape), packed.floats("free_distance_m", shape),
                packed.floats("point_m", (*shape, 3)), packed.floats("normal", (*shape, 3)),
                packed.ints("instance_id", shape), packed.ints("class_id", shape), packed.octets("status", shape))
