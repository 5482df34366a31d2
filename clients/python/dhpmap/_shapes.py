# SPDX-License-Identifier: BSD-3-Clause
"""Boxes, spheres and capsules."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dhpmap._arrays import frozen, positive, vector
from dhpmap._errors import bad_argument
from dhpmap._pose import pose_message, read_pose, read_vector, vector_message
from dhpmap.v1 import collision_pb2, edit_service_pb2, types_pb2


@dataclass(frozen=True, eq=False, slots=True)
class Box:
    """Upright, along the axes of the frame it is given in. min_m, max_m: (3,) corners in metres."""

    min_m: NDArray[np.float64]
    max_m: NDArray[np.float64]

    def __init__(self, min_m: ArrayLike, max_m: ArrayLike) -> None:
        low, high = vector("min_m", min_m), vector("max_m", max_m)
        if (low > high).any():
            raise bad_argument("min_m", f"{low.tolist()} is not below max_m {high.tolist()} in every axis")
        object.__setattr__(self, "min_m", frozen(low.copy()))
        object.__setattr__(self, "max_m", frozen(high.copy()))

    @property
    def size_m(self) -> NDArray[np.float64]:
        """(3,) from side to side."""
        return self.max_m - self.min_m

    @property
    def center_m(self) -> NDArray[np.float64]:
        """(3,) its middle."""
        return (self.min_m + self.max_m) / 2


@dataclass(frozen=True, eq=False, slots=True)
class OrientedBox:
    """A box that may be turned. T_map_box: (4, 4), from its middle, with its sides along the axes; size_m: (3,)."""

    T_map_box: NDArray[np.float64]
    size_m: NDArray[np.float64]

    @property
    def center_m(self) -> NDArray[np.float64]:
        """(3,) its middle, in the map frame."""
        return self.T_map_box[:3, 3]

    @property
    def yaw_rad(self) -> float:
        """How far its first side is turned from x, counterclockwise from above."""
        return float(np.arctan2(self.T_map_box[1, 0], self.T_map_box[0, 0]))


@dataclass(frozen=True, eq=False, slots=True)
class Sphere:
    """All within radius_m of center_m, (3,) in metres."""

    center_m: NDArray[np.float64]
    radius_m: float

    def __init__(self, center_m: ArrayLike, radius_m: float) -> None:
        object.__setattr__(self, "center_m", frozen(vector("center_m", center_m).copy()))
        object.__setattr__(self, "radius_m", positive("radius_m", radius_m))


@dataclass(frozen=True, eq=False, slots=True)
class Capsule:
    """All within radius_m of the segment from a_m to b_m, (3,) each, in metres."""

    a_m: NDArray[np.float64]
    b_m: NDArray[np.float64]
    radius_m: float

    def __init__(self, a_m: ArrayLike, b_m: ArrayLike, radius_m: float) -> None:
        object.__setattr__(self, "a_m", frozen(vector("a_m", a_m).copy()))
        object.__setattr__(self, "b_m", frozen(vector("b_m", b_m).copy()))
        object.__setattr__(self, "radius_m", positive("radius_m", radius_m))


Region = Box | Sphere
Body = Box | OrientedBox | Sphere | Capsule


def box_message(box: Box) -> types_pb2.AxisAlignedBox:
    return types_pb2.AxisAlignedBox(min_m=vector_message("min_m", box.min_m), max_m=vector_message("max_m", box.max_m))


def sphere_message(sphere: Sphere) -> types_pb2.Sphere:
    return types_pb2.Sphere(center_m=vector_message("center_m", sphere.center_m), radius_m=sphere.radius_m)


def read_box(message: types_pb2.AxisAlignedBox) -> Box:
    return Box(read_vector(message.min_m), read_vector(message.max_m))


def read_region(message: edit_service_pb2.IgnoredRegion) -> Region:
    if message.HasField("box"):
        return read_box(message.box)
    return Sphere(read_vector(message.sphere.center_m), message.sphere.radius_m)


def read_oriented_box(message: types_pb2.OrientedBox) -> OrientedBox:
    return OrientedBox(read_pose(message.pose), read_vector(message.size_m))


def body_message(body: Body) -> collision_pb2.Body:
    if isinstance(body, Sphere):
        return collision_pb2.Body(sphere=sphere_message(body))
    if isinstance(body, Capsule):
        return collision_pb2.Body(capsule=collision_pb2.Capsule(
            a_m=vector_message("a_m", body.a_m), b_m=vector_message("b_m", body.b_m), radius_m=body.radius_m))
    if isinstance(body, Box):
        matrix = np.eye(4)
        matrix[:3, 3] = body.center_m
        body = OrientedBox(matrix, body.size_m)
    return collision_pb2.Body(box=types_pb2.OrientedBox(
        pose=pose_message("T_map_box", body.T_map_box), size_m=vector_message("size_m", body.size_m)))
