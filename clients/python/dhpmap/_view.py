# SPDX-License-Identifier: BSD-3-Clause
"""What can be asked of a map, now or as it was at a revision."""
from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Unpack

from numpy.typing import ArrayLike

from dhpmap._contacts import BodyCheck, Collisions, check_bodies, check_spheres
from dhpmap._distances import Distances, query_distances
from dhpmap._errors import bad_argument
from dhpmap._grids import Slice, occupancy_slice
from dhpmap._objects import Object, ObjectLike
from dhpmap._options import QueryOptions, strings
from dhpmap._points import Points, Rays, cast_rays, query_points
from dhpmap._robot import PathCheck, Spheres, check_paths
from dhpmap._search import Relation, relations, search
from dhpmap._shapes import Body, Box, Region
from dhpmap._source import Source


class Queries:
    """Queries, each answered from one state of the map.

    Arrays go in as anything that numpy takes, of shape (..., 3) and so on, and come back as columns in the same shape.
    Lengths are metres; places are in the map's frame, or in that of the option T_map_query. All options are those of
    QueryOptions. Every query takes `deadline_s`, else the default of `connect`.

    Raises InvalidArgument for what cannot be asked so, NotFound for an object or map that is not there, OutOfRange for
    a revision that is not kept, Unavailable, DeadlineExceeded.
    """

    def __init__(self, source: Source) -> None:
        self._source = source

    def distances(self, points_m: ArrayLike, *, deadline_s: float | None = None,
                  **options: Unpack[QueryOptions]) -> Distances:
        """How far is the nearest surface of each point, which way, and whose is it? points_m: (..., 3).

        More than 1,000,000 points go in several calls, all of one revision.
        """
        return query_distances(self._source, points_m, options, deadline_s)

    def points(self, points_m: ArrayLike, *, deadline_s: float | None = None,
               **options: Unpack[QueryOptions]) -> Points:
        """What is at each point: an object's surface, free space, or nothing known? points_m: (..., 3).

        Of the options it takes T_map_query and min_revision.
        """
        return query_points(self._source, points_m, options, deadline_s)

    def rays(self, origins_m: ArrayLike, directions: ArrayLike, *, deadline_s: float | None = None,
             **options: Unpack[QueryOptions]) -> Rays:
        """What does each ray meet first? origins_m: (3,) for all, or (..., 3); directions: (..., 3) of any length."""
        return cast_rays(self._source, origins_m, directions, options, deadline_s)

    def collisions(self, spheres_m: ArrayLike, *, deadline_s: float | None = None,
                   **options: Unpack[QueryOptions]) -> Collisions:
        """Does each sphere touch anything? spheres_m: (..., 4), x, y, z, radius. Unseen space is in the way."""
        return check_spheres(self._source, spheres_m, options, deadline_s)

    def check_bodies(self, bodies: Sequence[Body], *, links: Sequence[str] = (), all_contacts: bool = False,
                     deadline_s: float | None = None, **options: Unpack[QueryOptions]) -> list[BodyCheck]:
        """The same of spheres, boxes and capsules; links: a name a body, for may_touch={"wheel": ["floor"]}."""
        return check_bodies(self._source, bodies, options, links=links, all_contacts=all_contacts,
                            deadline_s=deadline_s)

    def check_path(self, robot: Spheres, waypoints: ArrayLike, *, all_contacts: bool = False,
                   include_clearance: bool = False, deadline_s: float | None = None,
                   **options: Unpack[QueryOptions]) -> PathCheck:
        """Can the robot go this way without touching anything? What is between waypoints counts, too.

        waypoints: (H, 3) places x, y, z of the robot's frame, (H, 7) with quaternions x, y, z, w, or (H, 4, 4)
        T_map_robot.
        Unseen space is in the way, unless unknown="free". include_clearance takes longer.
        """
        return check_paths(self._source, robot, [waypoints], options, all_contacts=all_contacts,
                           include_clearance=include_clearance, deadline_s=deadline_s)[0]

    def check_paths(self, robot: Spheres, paths: Sequence[ArrayLike], *, all_contacts: bool = False,
                    include_clearance: bool = False, deadline_s: float | None = None,
                    **options: Unpack[QueryOptions]) -> list[PathCheck]:
        """The same of several paths, all of one revision."""
        return check_paths(self._source, robot, paths, options, all_contacts=all_contacts,
                           include_clearance=include_clearance, deadline_s=deadline_s)

    def find(self, class_name: str | Sequence[str] = (), *, near: ArrayLike | None = None, within: Region | None = None,
             name: str = "", limit: int = 100, deadline_s: float | None = None,
             **options: Unpack[QueryOptions]) -> list[Object]:
        """Objects of a class (or some), by their surfaces: in a region, with a part of a name.

        near: (3,) the nearest to it first, each with `distance_m` and `nearest_point_m`; else by id. max_distance_m
        counts from there. Empty where there is none; InvalidArgument for a class that the map does not know.
        """
        classes = [class_name] if isinstance(class_name, str) else strings("class_name", class_name)
        if limit < 1:
            raise bad_argument("limit", f"{limit} is not above 0")
        return search(self._source, classes, options, near=near, within=within, name=name, limit=limit,
                      deadline_s=deadline_s)

    def slice(self, min_z_m: float, max_z_m: float, *, area: Box | None = None, resolution_m: float | None = None,
              min_free_fraction: float | None = None, include_objects: bool = False, deadline_s: float | None = None,
              **options: Unpack[QueryOptions]) -> Slice:
        """What is occupied, free and unknown between two heights, from above; `save` writes it for nav2.

        area: a Box of which x and y count; default all that is known. resolution_m: default the map's voxel size.
        min_free_fraction: a cell is free if so much of it is, default 0.3. include_objects: whose surface occupies it.
        """
        return occupancy_slice(self._source, min_z_m, max_z_m, area, resolution_m, min_free_fraction, include_objects,
                               options, deadline_s)

    def relations(self, kinds: str | Iterable[str] = (), *, of: ObjectLike | None = None,
                  max_gap_m: float | None = None, limit: int = 1000, deadline_s: float | None = None,
                  **options: Unpack[QueryOptions]) -> list[Relation]:
        """What is "on", "in" or "next_to" what; of: only those of one object. max_gap_m is of next_to, default 0.5."""
        wanted = [kinds] if isinstance(kinds, str) else kinds
        return relations(self._source, wanted, of, options, max_gap_m=max_gap_m, limit=limit, deadline_s=deadline_s)
