# SPDX-License-Identifier: BSD-3-Clause
"""How far is the nearest surface, which way, and whose is it."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dhpmap._arrays import rows
from dhpmap._columns import CLAMPED, UNKNOWN, ask_packed, is_status
from dhpmap._options import QueryOptions, options_message
from dhpmap._source import Source
from dhpmap._wire import floats_field
from dhpmap.v1 import query_service_pb2 as pb2


@dataclass(frozen=True, eq=False, slots=True)
class Distances:
    """Columns in the shape of the points that were asked, (...) or (..., 3); in the frame they were asked in.

    Attributes:
        revision: of the map, that all are of.
        distance_m: (...); below 0 behind a surface; nothing within reach: max_distance_m.
        gradient: (..., 3) of the distance, unit; nothing within reach: 0.
        nearest_point_m: (..., 3) on the surface; nothing within reach: NaN.
        object_id: (...) whose surface; 0: unknown object, -1: nothing within reach.
        class_id: (...) -1: it has no class.
        status: (...) as in QueryStatus: 1 ok, 2 clamped, 3 unknown.
    """

    revision: int
    distance_m: NDArray[np.float32]
    gradient: NDArray[np.float32]
    nearest_point_m: NDArray[np.float32]
    object_id: NDArray[np.int64]
    class_id: NDArray[np.int64]
    status: NDArray[np.uint8]

    @property
    def known(self) -> NDArray[np.bool_]:
        """(...) whether sensors have seen what is at the point; elsewhere the rest is about what is known."""
        return ~is_status(self.status, UNKNOWN)

    @property
    def clamped(self) -> NDArray[np.bool_]:
        """(...) whether there is no surface within max_distance_m."""
        return is_status(self.status, CLAMPED)

    def __len__(self) -> int:
        return len(self.distance_m)


def query_distances(source: Source, points_m: ArrayLike, options: QueryOptions,
                    deadline_s: float | None = None) -> Distances:
    points, shape = rows("points_m", points_m, 3, "x, y, z in metres")
    head = pb2.QueryDistancesRequest(map=source.map_name, packed=True,
                                     options=options_message(source.map_name, options))

    def request(part: slice, revision: int) -> bytes:
        head.read_revision = revision
        return head.SerializeToString() + floats_field(head.DESCRIPTOR, "packed_points_m", points[part])

    packed = ask_packed(source, pb2.QueryDistancesRequest, pb2.QueryDistancesResponse, len(points), request,
                        deadline_s=deadline_s)
    return Distances(packed.revision, packed.floats("distance_m", shape), packed.floats("gradient", (*shape, 3)),
                     packed.floats("nearest_point_m", (*shape, 3)), packed.ints("instance_id", shape),
                     packed.ints("class_id", shape), packed.octets("status", shape))
