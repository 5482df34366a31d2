# SPDX-License-Identifier: BSD-3-Clause
"""Which objects are there, and what is on, in or next to what."""
from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from dhpmap._call import Caller
from dhpmap._errors import NotFound
from dhpmap._objects import Object, ObjectLike, Ref, id_of_name, read_match, read_object, submap_name
from dhpmap._options import QueryOptions, choice, listed, options_message
from dhpmap._pose import vector_message
from dhpmap._shapes import Box, Region, box_message, sphere_message
from dhpmap._source import Source, ask
from dhpmap.v1 import search_pb2, submap_service_pb2


class Objects(Collection[Object]):
    """All objects of a map, looked up when they are asked for: `objects[42]`, `for one in objects`, `len(objects)`."""

    def __init__(self, caller: Caller, map_name: str, read_revision: int = 0) -> None:
        self._caller, self._map_name, self._read_revision = caller, map_name, read_revision

    def __getitem__(self, thing: ObjectLike) -> Object:
        """Raises NotFound, reason MERGED_INTO for one that is a part of another now."""
        request = submap_service_pb2.GetSubmapRequest(name=submap_name(self._map_name, thing),
                                                      read_revision=self._read_revision)
        answer = self._caller.unary("SubmapService/GetSubmap", request, submap_service_pb2.GetSubmapResponse)
        return read_object(answer.submap)

    def __iter__(self) -> Iterator[Object]:
        """By ascending id, absent ones and the unknown object 0 as well; each page of the map's state at its time."""
        request = submap_service_pb2.ListSubmapsRequest(parent=self._map_name, read_revision=self._read_revision)
        while True:
            page = self._caller.unary("SubmapService/ListSubmaps", request, submap_service_pb2.ListSubmapsResponse)
            yield from map(read_object, page.submaps)
            if not page.next_page_token:
                return
            request.page_token = page.next_page_token

    def __contains__(self, thing: object) -> bool:
        if not isinstance(thing, (Object, Ref, int, np.integer)):
            return False
        try:
            return bool(self[thing if isinstance(thing, (Object, Ref)) else int(thing)].etag)
        except NotFound:
            return False

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __repr__(self) -> str:
        return f"<{len(self)} objects of {self._map_name}>"

    def _repr_html_(self) -> str:
        from dhpmap._show import objects_html
        return objects_html(self)


@dataclass(frozen=True, slots=True)
class Relation:
    """One thing to another, by the geometry of their surfaces.

    Attributes:
        kind: "on", "in" or "next_to".
        support: on: share of the subject's supported footprint that the object supports.
        enclosure: in: share of what is around, below and above the subject that is the object.
        gap_m: between the surfaces, to half a voxel or so.
    """

    kind: str
    subject: Ref
    object: Ref
    subject_name: str
    object_name: str
    support: float
    enclosure: float
    gap_m: float

    def __str__(self) -> str:
        return f"{self.subject_name} {self.kind.replace('_', ' ')} {self.object_name}"


MOST_A_PAGE = 1000
_RELATIONS = {"on": search_pb2.Relation.ON, "in": search_pb2.Relation.IN, "next_to": search_pb2.Relation.NEXT_TO}
_RELATION_NAMES = {number: name for name, number in _RELATIONS.items()}


def search(source: Source, class_names: Iterable[str], options: QueryOptions, *, near: ArrayLike | None,
           within: Region | None, name: str, limit: int, deadline_s: float | None) -> list[Object]:
    request = search_pb2.SearchSubmapsRequest(map=source.map_name, name_part=name,
                                              read_revision=source.read_revision,
                                              options=options_message(source.map_name, options))
    request.options.class_names.extend(class_names)
    if near is not None:
        request.near_point_m.CopyFrom(vector_message("near", near))
    if isinstance(within, Box):
        request.region.CopyFrom(box_message(within))
    elif within is not None:
        request.sphere.CopyFrom(sphere_message(within))
    found: list[Object] = []
    while len(found) < limit:
        request.page_size = min(limit - len(found), MOST_A_PAGE)
        page = ask(source, request, search_pb2.SearchSubmapsResponse, deadline_s=deadline_s)
        found += map(read_match, page.matches)
        if not page.next_page_token:
            break
        request.page_token = page.next_page_token
    return found


def relations(source: Source, kinds: Iterable[str], of: ObjectLike | None, options: QueryOptions, *,
              max_gap_m: float | None, limit: int, deadline_s: float | None) -> list[Relation]:
    request = search_pb2.QueryRelationsRequest(
        map=source.map_name, kinds=[choice("kinds", kind, _RELATIONS) for kind in listed("kinds", kinds)],
        max_gap_m=max_gap_m, options=options_message(source.map_name, options),
        read_revision=source.read_revision)
    if of is not None:
        request.submap = submap_name(source.map_name, of)
    found: list[Relation] = []
    while len(found) < limit:
        request.page_size = min(limit - len(found), MOST_A_PAGE)
        page = ask(source, request, search_pb2.QueryRelationsResponse, deadline_s=deadline_s)
        found += map(_read_relation, page.relations)
        if not page.next_page_token:
            break
        request.page_token = page.next_page_token
    return found


def _read_relation(its: search_pb2.Relation) -> Relation:
    return Relation(_RELATION_NAMES.get(its.kind, "?"), Ref(id_of_name(its.subject)), Ref(id_of_name(its.object)),
                    its.subject_display_name, its.object_display_name, its.support, its.enclosure, its.gap_m)
