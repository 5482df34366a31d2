# SPDX-License-Identifier: BSD-3-Clause
"""Robots of spheres, and whether they can go along a path."""
from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dhpmap._arrays import frozen, numbers
from dhpmap._contacts import Contact, read_contact
from dhpmap._errors import bad_argument
from dhpmap._objects import Ref, id_of_name
from dhpmap._options import QueryOptions, Touched, listed, options_message
from dhpmap._pose import pose_message, read_path, read_vector
from dhpmap._source import Source, ask
from dhpmap.v1 import collision_pb2 as pb2
from dhpmap.v1 import query_options_pb2, types_pb2


class Spheres:
    """A rigid robot: spheres in its own frame.

    spheres_m: (S, 4) x, y, z, radius in metres. may_touch: objects, and classes by name, that all of it may touch.
    links: a name a sphere, for may_touch={"wheel": ["floor"]} of a query.
    """

    def __init__(self, spheres_m: ArrayLike, *, may_touch: Iterable[Touched] = (), links: Sequence[str] = ()) -> None:
        spheres = numbers("spheres_m", spheres_m)
        if spheres.ndim != 2 or spheres.shape[1] != 4 or len(spheres) == 0:
            raise bad_argument("spheres_m", f"wanted (S, 4): x, y, z, radius; got shape {spheres.shape}")
        if (spheres[:, 3] < 0).any():
            raise bad_argument("spheres_m", "a radius is below 0")
        if links and len(links) != len(spheres):
            raise bad_argument("links", f"{len(links)} names for {len(spheres)} spheres")
        self.spheres_m: NDArray[np.float64] = frozen(spheres.copy())
        self.may_touch = tuple(listed("may_touch", may_touch))
        self.links = tuple(links)

    def __repr__(self) -> str:
        return f"Spheres({self.spheres_m.tolist()}, may_touch={list(map(str, self.may_touch))})"


@dataclass(frozen=True, slots=True)
class PathContact(Contact):
    """Where a path meets something first.

    Attributes:
        waypoint: after this one,.
        fraction: at this share of the way to the next.
        sphere: which one of the robot; -1: what it carries.
        attached: which of that.
    """

    waypoint: int
    fraction: float
    sphere: int
    attached: Ref | None


@dataclass(frozen=True, slots=True)
class Clearance:
    """Where a path is nearest to a surface that it must not touch.

    Attributes:
        distance_m: from the robot's surface, padding taken off; below 0: so deep.
        point_m: (3,) on the surface.
    """

    distance_m: float
    waypoint: int
    fraction: float
    sphere: int
    object: Ref
    point_m: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class PathCheck:
    """Whether a robot can go along a path.

    Attributes:
        ok: it touches nothing on all its way.
        known: False: before it touches any surface it goes where nobody has looked.
        contacts: the first; with all_contacts the first with each object.
        clearance: with include_clearance, where a surface is within max_distance_m.
    """

    ok: bool
    known: bool
    contacts: tuple[PathContact, ...]
    clearance: Clearance | None
    revision: int

    @property
    def contact(self) -> PathContact | None:
        """The first contact; None: it is free to go."""
        return self.contacts[0] if self.contacts else None

    def __bool__(self) -> bool:
        return self.ok


def check_paths(source: Source, robot: Spheres, paths: Sequence[ArrayLike], options: QueryOptions, *,
                all_contacts: bool, include_clearance: bool, deadline_s: float | None) -> list[PathCheck]:
    if not isinstance(robot, Spheres):
        raise bad_argument("robot", f"wanted dhpmap.Spheres([(x, y, z, radius), ...]), got {robot!r}")
    request = pb2.CheckTrajectoryRequest(
        map=source.map_name, all_contacts=all_contacts, include_clearance=include_clearance,
        read_revision=source.read_revision, sphere_links=robot.links,
        options=options_message(source.map_name, with_may_touch(options, robot.may_touch)))
    for x, y, z, radius_m in robot.spheres_m.tolist():
        request.robot.append(types_pb2.Sphere(center_m=types_pb2.Vector3(x=x, y=y, z=z), radius_m=radius_m))
    for number, path in enumerate(paths):
        trajectory = request.trajectories.add()
        name = "waypoints" if len(paths) == 1 else f"paths[{number}]"
        trajectory.waypoints.extend(pose_message(name, matrix) for matrix in read_path(name, path))
    answer = ask(source, request, pb2.CheckTrajectoryResponse, deadline_s=deadline_s)
    return [_read_result(result, answer.revision) for result in answer.results]


def with_may_touch(options: QueryOptions, touched: Iterable[Touched]) -> QueryOptions:
    """The options, and what the whole robot may touch."""
    given = options.get("may_touch", ())
    by_part = dict(given) if isinstance(given, Mapping) else {None: listed("may_touch", given)}
    by_part[None] = [*by_part.get(None, ()), *touched]
    merged = options.copy()
    merged["may_touch"] = by_part
    return merged


def _read_result(result: pb2.TrajectoryResult, revision: int) -> PathCheck:
    clearance = _read_clearance(result.clearance) if result.HasField("clearance") else None
    return PathCheck(result.valid, result.status != query_options_pb2.QueryStatus.UNKNOWN,
                     tuple(map(_read_path_contact, result.contacts)), clearance, revision)


def _read_path_contact(message: pb2.TrajectoryContact) -> PathContact:
    contact = read_contact(message.contact)
    attached = Ref(id_of_name(message.attached)) if message.attached else None
    return PathContact(contact.object, contact.depth_m, contact.point_m, contact.normal, message.waypoint,
                       message.fraction, message.sphere, attached)


def _read_clearance(message: pb2.Clearance) -> Clearance:
    return Clearance(message.distance_m, message.waypoint, message.fraction, message.sphere,
                     Ref(message.instance_id, message.class_name), read_vector(message.point_m))
