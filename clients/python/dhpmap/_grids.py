# SPDX-License-Identifier: BSD-3-Clause
"""Slices and grids of distances as arrays."""
from __future__ import annotations

import pathlib
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dhpmap._arrays import numbers, vector
from dhpmap._call import Caller
from dhpmap._columns import UNKNOWN, is_status
from dhpmap._errors import bad_argument
from dhpmap._options import QueryOptions, options_message, scalar
from dhpmap._picture import distance_colors, png_of, slice_colors
from dhpmap._shapes import Box, box_message
from dhpmap._source import Source
from dhpmap._wire import read_columns
from dhpmap.v1 import occupancy_pb2 as pb2


@dataclass(frozen=True, eq=False, slots=True)
class Slice:
    """What is occupied, free and unknown in a band of heights, from above. cells[row, column]: row 0 has the least y.

    Attributes:
        cells: (H, W) 0 free, 100 occupied, -1 unknown, as in nav_msgs/OccupancyGrid.
        resolution_m: side of a cell.
        origin_m: (3,) outer corner of cells[0, 0], at the bottom of the band.
        object_id: (H, W) with include_objects: whose surface occupies it; -1: not occupied.
    """

    revision: int
    cells: NDArray[np.int8]
    resolution_m: float
    origin_m: NDArray[np.float64]
    object_id: NDArray[np.int64] | None

    @property
    def occupied(self) -> NDArray[np.bool_]:
        """(H, W)"""
        is_so: NDArray[np.bool_] = self.cells == 100
        return is_so

    @property
    def free(self) -> NDArray[np.bool_]:
        """(H, W)"""
        is_so: NDArray[np.bool_] = self.cells == 0
        return is_so

    def places(self, z_m: float | None = None) -> NDArray[np.float64]:
        """(H, W, 3) the middle of each cell, at a height; by default at the bottom of the band."""
        row, column = np.indices(self.cells.shape)
        z = np.full(self.cells.shape, self.origin_m[2] if z_m is None else z_m)
        return np.stack([self.origin_m[0] + (column + 0.5) * self.resolution_m,
                         self.origin_m[1] + (row + 0.5) * self.resolution_m, z], axis=-1)

    def cell_of(self, place_m: ArrayLike) -> tuple[int, int]:
        """(row, column) of the cell at x, y; the nearest one of a place outside."""
        x, y = ((numbers("place_m", place_m)[:2] - self.origin_m[:2]) // self.resolution_m).astype(int).tolist()
        return min(max(y, 0), self.cells.shape[0] - 1), min(max(x, 0), self.cells.shape[1] - 1)

    def save(self, path: str | pathlib.Path) -> None:
        """Writes PATH.pgm and PATH.yaml, a map for nav2's map server."""
        path = pathlib.Path(path).with_suffix(".pgm")
        grey = np.select([self.occupied, self.free], [0, 254], 205).astype(np.uint8)[::-1]
        height, width = grey.shape
        path.write_bytes(b"P5\n%d %d\n255\n" % (width, height) + grey.tobytes())
        x, y = self.origin_m[:2].tolist()
        path.with_suffix(".yaml").write_text(
            f"image: {path.name}\nmode: trinary\nresolution: {self.resolution_m!r}\norigin: [{x!r}, {y!r}, 0.0]\n"
            "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n")

    def _repr_png_(self) -> bytes:
        return png_of(slice_colors(self.cells, self.object_id))


@dataclass(frozen=True, eq=False, slots=True)
class DistanceGrid:
    """Distances at the nodes of a grid: node [i, j, k] is at origin_m + (i, j, k) * resolution_m.

    Attributes:
        distance_m: (X, Y, Z) as in Distances.
        gradient: (X, Y, Z, 3) with include_gradients.
        object_id: (X, Y, Z) with include_objects.
        status: (X, Y, Z).
        origin_m: (3,).
    """

    revision: int
    distance_m: NDArray[np.float32]
    gradient: NDArray[np.float32] | None
    object_id: NDArray[np.int64] | None
    status: NDArray[np.uint8]
    origin_m: NDArray[np.float64]
    resolution_m: float

    @property
    def known(self) -> NDArray[np.bool_]:
        """(X, Y, Z) whether sensors have seen what is at the node."""
        return ~is_status(self.status, UNKNOWN)

    def _repr_png_(self) -> bytes:
        middle = self.distance_m.shape[2] // 2
        return png_of(distance_colors(self.distance_m[..., middle].T, self.known[..., middle].T))


def occupancy_slice(source: Source, min_z_m: float, max_z_m: float, area: Box | None, resolution_m: float | None,
                    min_free_fraction: float | None, include_objects: bool, options: QueryOptions,
                    deadline_s: float | None) -> Slice:
    request = pb2.QueryOccupancySliceRequest(
        map=source.map_name, min_z_m=scalar("min_z_m", min_z_m), max_z_m=scalar("max_z_m", max_z_m),
        resolution_m=resolution_m, min_free_fraction=min_free_fraction, include_objects=include_objects,
        format=pb2.QueryOccupancySliceRequest.CELLS, options=options_message(source.map_name, options),
        read_revision=source.read_revision)
    if area is not None:
        low, high = area.min_m.tolist(), area.max_m.tolist()
        request.area.CopyFrom(pb2.SliceArea(min_x_m=low[0], min_y_m=low[1], max_x_m=high[0], max_y_m=high[1]))
    data = source.answer(type(request), request.SerializeToString(), deadline_s=deadline_s)
    answer = pb2.QueryOccupancySliceResponse.FromString(data)
    shape = (answer.height, answer.width)
    cells = np.frombuffer(answer.cells, np.int8).reshape(shape)
    owners = None
    if include_objects:
        ids = np.array([-1] + [its.instance_id for its in answer.objects], np.int64)
        indices = read_columns(memoryview(data), answer.DESCRIPTOR)["object_indices"]
        owners = ids[indices.astype(np.int64)].reshape(shape)
    origin_m = np.array([answer.origin_m.x, answer.origin_m.y, answer.origin_m.z])
    return Slice(answer.revision, cells, answer.resolution_m, origin_m, owners)


def distance_grid(caller: Caller, map_name: str, read_revision: int, box: Box, resolution_m: float,
                  include_gradients: bool, include_objects: bool, options: QueryOptions,
                  deadline_s: float | None) -> DistanceGrid:
    if not isinstance(box, Box):
        raise bad_argument("box", f"wanted a dhpmap.Box(min_m, max_m), got {box!r}")
    request = pb2.QueryDistanceGridRequest(
        map=map_name, box=box_message(box), resolution_m=scalar("resolution_m", resolution_m),
        include_gradients=include_gradients, include_objects=include_objects,
        options=options_message(map_name, options), read_revision=read_revision)
    parts = [read_columns(memoryview(data), pb2.QueryDistanceGridResponse.DESCRIPTOR) for data in
             caller.raw_stream("QueryService/QueryDistanceGrid", request.SerializeToString(), deadline_s=deadline_s)]
    size = tuple(int(parts[0][name][0]) for name in ("num_x", "num_y", "num_z"))

    def column(name: str, *inner: int) -> NDArray[np.generic]:
        flat = np.concatenate([part[name] for part in parts])
        return np.moveaxis(flat.reshape(*size[::-1], *inner), (0, 1, 2), (2, 1, 0))

    return DistanceGrid(int(parts[0]["revision"][0]), column("distance_m").astype(np.float32, copy=False),
                        column("gradient", 3).astype(np.float32, copy=False) if include_gradients else None,
                        column("instance_id").astype(np.int64, copy=False) if include_objects else None,
                        column("status").astype(np.uint8), vector("min_m", box.min_m), resolution_m)
