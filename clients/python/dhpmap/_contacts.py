# SPDX-License-Identifier: BSD-3-Clause
"""Bodies against surfaces."""
from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dhpmap._arrays import rows
from dhpmap._columns import UNKNOWN, ask_packed, is_status
from dhpmap._objects import Ref
from dhpmap._options import QueryOptions, options_message
from dhpmap._pose import read_vector
from dhpmap._shapes import Body, body_message
from dhpmap._source import Source, ask
from dhpmap._wire import floats_field
from dhpmap.v1 import collision_pb2 as pb2


@dataclass(frozen=True, slots=True)
class Contact:
    """Where something touches a surface, or is where nobody has seen.

    Attributes:
        object: id 0: an unknown object, -1: unseen space.
        depth_m: how far out along the normal until the contact ends.
        point_m: (3,) on the surface; in unseen space the middle of a voxel.
        normal: (3,) out of the surface, unit; in unseen space 0.
    """

    object: Ref
    depth_m: float
    point_m: NDArray[np.float64]
    normal: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class BodyCheck:
    """Whether one body touches anything.

    Attributes:
        known: False: it touches nothing, but is where nobody has looked.
        contacts: the deepest; with all_contacts one with each object.
    """

    colliding: bool
    known: bool
    contacts: tuple[Contact, ...]

    def __bool__(self) -> bool:
        return self.colliding


@dataclass(frozen=True, eq=False, slots=True)
class Collisions:
    """Columns in the shape of the spheres that were asked, (...) or (..., 3).

    Attributes:
        colliding: (...).
        depth_m: (...) of the deepest contact; touches nothing: 0.
        point_m: (..., 3) on the surface; touches nothing: NaN.
        normal: (..., 3) out of the surface; touches nothing, or in unseen space: 0.
        object_id: (...) touches nothing, or in unseen space: -1.
        class_id: (...) -1: it has no class.
        status: (...) 1 ok, 3 unknown.
    """

    revision: int
    colliding: NDArray[np.bool_]
    depth_m: NDArray[np.float32]
    point_m: NDArray[np.float32]
    normal: NDArray[np.float32]
    object_id: NDArray[np.int64]
    class_id: NDArray[np.int64]
    status: NDArray[np.uint8]

    @property
    def known(self) -> NDArray[np.bool_]:
        """(...) False: it touches nothing, but is where nobody has looked."""
        return ~is_status(self.status, UNKNOWN)


def read_contact(message: pb2.Contact) -> Contact:
    return Contact(Ref(message.instance_id, message.class_name), message.depth_m, read_vector(message.point_m),
                   read_vector(message.normal))


def check_spheres(source: Source, spheres_m: ArrayLike, options: QueryOptions,
                  deadline_s: float | None = None) -> Collisions:
    spheres, shape = rows("spheres_m", spheres_m, 4, "x, y, z, radius in metres")
    head = pb2.CheckCollisionsRequest(map=source.map_name, packed=True,
                                      options=options_message(source.map_name, options))

    def request(part: slice, revision: int) -> bytes:
        head.read_revision = revision
        return head.SerializeToString() + floats_field(head.DESCRIPTOR, "packed_spheres_m", spheres[part])

    packed = ask_packed(source, pb2.CheckCollisionsRequest, pb2.CheckCollisionsResponse, len(spheres), request,
                        deadline_s=deadline_s)
    return Collisions(packed.revision, packed.bools("colliding", shape), packed.floats("depth_m", shape),
                      packed.floats("point_m", (*shape, 3)), packed.floats("normal", (*shape, 3)),
                      packed.ints("instance_id", shape), packed.ints("class_id", shape),
                      packed.octets("status", shape))


def check_bodies(source: Source, bodies: Sequence[Body], options: QueryOptions, *, links: Sequence[str],
                 all_contacts: bool, deadline_s: float | None) -> list[BodyCheck]:
    request = pb2.CheckCollisionsRequest(
        map=source.map_name, bodies=[body_message(body) for body in bodies], all_contacts=all_contacts,
        options=options_message(source.map_name, options), read_revision=source.read_revision, body_links=links)
    answer = ask(source, request, pb2.CheckCollisionsResponse, deadline_s=deadline_s)
    return [BodyCheck(result.colliding, result.status != UNKNOWN, tuple(map(read_contact, result.contacts)))
            for result in answer.results]
