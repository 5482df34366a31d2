# SPDX-License-Identifier: BSD-3-Clause
"""A map to be read: as it is, or as it was at a revision."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Unpack

from dhpmap._call import Caller
from dhpmap._geometry import Mesh, Voxels, read_mesh, read_voxels
from dhpmap._grids import DistanceGrid, distance_grid
from dhpmap._objects import ObjectLike
from dhpmap._options import QueryOptions
from dhpmap._search import Objects
from dhpmap._shapes import Box, Region, read_region
from dhpmap._source import CalledSource, EventualSource
from dhpmap._view import Queries
from dhpmap.v1 import edit_service_pb2


class MapView(Queries):
    """What Map and PastMap have in common."""

    def __init__(self, caller: Caller, map_name: str, read_revision: int = 0) -> None:
        super().__init__(CalledSource(caller, map_name, read_revision))
        self._caller, self._read_revision = caller, read_revision
        self.resource_name = map_name  # maps/{map}

    @property
    def name(self) -> str:
        """The last part of its resource name."""
        return self.resource_name.removeprefix("maps/")

    @property
    def objects(self) -> Objects:
        """All objects: `m.objects[42]`, `for one in m.objects`; each look goes to the server."""
        return Objects(self._caller, self.resource_name, self._read_revision)

    def distance_grid(self, box: Box, resolution_m: float, *, include_gradients: bool = False,
                      include_objects: bool = False, deadline_s: float | None = None,
                      **options: Unpack[QueryOptions]) -> DistanceGrid:
        """Distances at the nodes of a grid in a box, at most 16,000,000."""
        return distance_grid(self._caller, self.resource_name, self._read_revision, box, resolution_m,
                             include_gradients, include_objects, options, deadline_s)

    def mesh(self, thing: ObjectLike | None = None, *, deadline_s: float | None = None) -> Mesh:
        """The surface of an object, or of all that are present."""
        return read_mesh(self._caller, self.resource_name, self._read_revision, thing, deadline_s)

    def voxels(self, thing: ObjectLike, *, max_abs_tsdf_m: float = 0, deadline_s: float | None = None) -> Voxels:
        """The observed voxels of an object; with max_abs_tsdf_m only those so near to its surface."""
        return read_voxels(self._caller, self.resource_name, self._read_revision, thing, max_abs_tsdf_m, deadline_s)

    @property
    def ignored_regions(self) -> Mapping[str, Region]:
        """Where no frame puts anything, by name; see Edit.ignore_region."""
        request = edit_service_pb2.ListIgnoredRegionsRequest(parent=self.resource_name,
                                                             read_revision=self._read_revision)
        found: dict[str, Region] = {}
        while True:
            page = self._caller.unary("EditService/ListIgnoredRegions", request,
                                      edit_service_pb2.ListIgnoredRegionsResponse)
            found |= {its.name: read_region(its) for its in page.ignored_regions}
            if not page.next_page_token:
                return found
            request.page_token = page.next_page_token


class PastMap(MapView):
    """A map as it was at a revision. Queries raise OutOfRange (reason REVISION_NOT_KEPT) once it is no longer kept."""

    @property
    def revision(self) -> int:
        return self._read_revision

    def __repr__(self) -> str:
        return f"<{self.resource_name} at revision {self.revision}>"


class EventualMap(Queries):
    """A map as the server that is asked has it; see Map.eventual."""

    def __init__(self, caller: Caller, map_name: str) -> None:
        super().__init__(EventualSource(caller, map_name))
        self.resource_name = map_name

    def __repr__(self) -> str:
        return f"<{self.resource_name}, eventual>"
