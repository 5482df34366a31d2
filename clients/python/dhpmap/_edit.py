# SPDX-License-Identifier: BSD-3-Clause
"""Edits of a map: a list that is done as one revision, or not at all."""
from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from types import TracebackType

from numpy.typing import ArrayLike

from dhpmap._arrays import vector
from dhpmap._call import Caller, new_request_id
from dhpmap._errors import bad_argument
from dhpmap._objects import Object, ObjectLike, id_of_name, submap_name
from dhpmap._pose import pose_message, vector_message
from dhpmap._shapes import Box, Region, box_message, sphere_message
from dhpmap.v1 import edit_service_pb2 as pb2
from dhpmap.v1 import types_pb2


@dataclass(frozen=True, slots=True)
class New:
    """What an earlier edit of the same list makes; of several objects the one with the smallest id."""

    step: int


@dataclass(frozen=True, slots=True)
class Plane:
    """Through point_m, (3,), with a normal, (3,), of any length."""

    point_m: ArrayLike
    normal: ArrayLike


@dataclass(frozen=True, slots=True)
class EditResult:
    """What one edit did to objects, by their ids.

    Attributes:
        num_voxels: that a split gave to new objects, or that were cleared.
    """

    changed: tuple[int, ...]
    created: tuple[int, ...]
    removed: tuple[int, ...]
    num_voxels: int


Editable = ObjectLike | New


class Edit:
    """Collects edits; leaving the `with` block does them all. An exception within it does none.

    Afterwards `revision` has the map's new revision and `results` one EditResult an edit.
    """

    def __init__(self, caller: Caller, map_name: str, *, author: str, expected_revision: int = 0,
                 only_if_unedited: bool = False, deadline_s: float | None = None) -> None:
        self._caller, self._map_name, self._deadline_s = caller, map_name, deadline_s
        self._only_if_unedited = only_if_unedited
        self._request = pb2.ApplyEditsRequest(map=map_name, author=author, expected_revision=expected_revision)
        self.revision: int | None = None
        self.results: tuple[EditResult, ...] = ()

    def move(self, thing: Editable, *, by_m: ArrayLike | None = None, turn_rad: float | None = None,
             to: ArrayLike | None = None, include_supported: bool = False) -> None:
        """By (3,) metres, turned about its middle (counterclockwise from above), or to T_map_object, (4, 4).

        include_supported: what stands on it goes along. One of the three is given.
        """
        if (by_m is not None) + (turn_rad is not None) + (to is not None) != 1:
            raise bad_argument("move", "give one of by_m, turn_rad and to")
        edit = self._add(thing)
        if by_m is not None:
            edit.translate.offset_m.CopyFrom(vector_message("by_m", by_m))
            edit.translate.include_supported = include_supported
        elif turn_rad is not None:
            edit.turn.angle_rad = turn_rad
            edit.turn.include_supported = include_supported
        elif to is not None:
            edit.move.map_from_submap.CopyFrom(pose_message("to", to))
            edit.move.include_supported = include_supported

    def place(self, thing: Editable, *, on: Editable, at_m: ArrayLike | None = None,
              include_supported: bool = False) -> None:
        """Onto another object: at (2,) x, y in the map frame, else in the middle of its upper side."""
        edit = self._add(thing)
        edit.place.support = self._name(on)
        edit.place.include_supported = include_supported
        if at_m is not None:
            x, y = vector("at_m", at_m, 2).tolist()
            edit.place.point_m.CopyFrom(types_pb2.Vector3(x=x, y=y))

    def clone(self, thing: Editable, *, to: ArrayLike | None = None, name: str = "") -> New:
        """A copy, at T_map_object (4, 4), else where the original is; what it returns may be edited on."""
        edit = self._add(thing)
        edit.clone.display_name = name
        if to is not None:
            edit.clone.map_from_submap.CopyFrom(pose_message("to", to))
        return self._new()

    def delete(self, thing: Editable) -> None:
        self._add(thing).delete.SetInParent()

    def undelete(self, thing: Editable) -> None:
        """Brings back what an earlier edit has deleted."""
        self._add(thing).undelete.SetInParent()

    def relabel(self, thing: Editable, class_name: str) -> None:
        """Another class of its kind."""
        self._add(thing).relabel.class_name = class_name

    def rename(self, thing: Editable, name: str) -> None:
        """For people; "" follows the class again."""
        edit = self._add(thing)
        edit.rename.display_name = name
        edit.rename.SetInParent()

    def merge(self, thing: Editable, others: Iterable[Editable]) -> None:
        """The others become parts of this thing."""
        self._add(thing).merge.merged_submaps.extend(self._name(other) for other in others)

    def split(self, thing: Editable, by: Box | Plane | int, *, class_name: str = "") -> New:
        """Parts become objects: what lies in a box or in front of a plane, or each connected part but the largest.

        by: of connected parts, so many voxels at least.
        """
        edit = self._add(thing)
        edit.split.class_name = class_name
        if isinstance(by, Box):
            edit.split.box.CopyFrom(box_message(by))
        elif isinstance(by, Plane):
            edit.split.plane.point_m.CopyFrom(vector_message("point_m", by.point_m))
            edit.split.plane.normal.CopyFrom(vector_message("normal", by.normal))
        else:
            edit.split.parts.min_voxels = by
        return self._new()

    def clear(self, region: Region, *, thing: Editable | None = None, classes: Sequence[str] = ()) -> None:
        """Forgets what was observed in a region: of one object, of some classes, or of all."""
        edit = self._add(thing)
        edit.clear.class_names.extend(classes)
        if isinstance(region, Box):
            edit.clear.box.CopyFrom(box_message(region))
        else:
            edit.clear.sphere.CopyFrom(sphere_message(region))

    def ignore_region(self, name: str, region: Region) -> None:
        """From now on no frame puts anything there."""
        edit = self._add(None)
        edit.ignore_region.name = name
        if isinstance(region, Box):
            edit.ignore_region.box.CopyFrom(box_message(region))
        else:
            edit.ignore_region.sphere.CopyFrom(sphere_message(region))

    def unignore_region(self, name: str) -> None:
        """Frames are taken there again."""
        self._add(None).unignore_region.name = name

    def set_present(self, thing: Editable, is_present: bool) -> None:
        """Whether a thing is there, until sensors see otherwise."""
        self._add(thing).presence.presence = types_pb2.Submap.PRESENT if is_present else types_pb2.Submap.ABSENT

    def lock(self, thing: Editable) -> None:
        """Mapping leaves it as it is from now on."""
        self._add(thing).lock.SetInParent()

    def unlock(self, thing: Editable) -> None:
        self._add(thing).unlock.SetInParent()

    def preview(self) -> tuple[EditResult, ...]:
        """What the edits so far would do; changes nothing. Raises what doing them would."""
        request = pb2.ApplyEditsRequest()
        request.CopyFrom(self._request)
        request.validate_only = True
        return self._send(request)[1]

    def _add(self, thing: Editable | None) -> pb2.Edit:
        edit = self._request.edits.add()
        if thing is not None:
            edit.submap = self._name(thing)
        if self._only_if_unedited and isinstance(thing, Object):
            edit.etag = thing.etag
        return edit

    def _name(self, thing: Editable) -> str:
        return f"#{thing.step}" if isinstance(thing, New) else submap_name(self._map_name, thing)

    def _new(self) -> New:
        return New(len(self._request.edits) - 1)

    def _send(self, request: pb2.ApplyEditsRequest) -> tuple[int, tuple[EditResult, ...]]:
        answer = self._caller.unary("EditService/ApplyEdits", request, pb2.ApplyEditsResponse,
                                    deadline_s=self._deadline_s)
        return answer.revision, tuple(
            EditResult(ids(result.changed_submaps), ids(result.created_submaps), ids(result.removed_submaps),
                       result.num_voxels) for result in answer.results)

    def __enter__(self) -> Edit:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        if kind is None and self._request.edits:
            self._request.request_id = new_request_id()
            self.revision, self.results = self._send(self._request)


def ids(names: Iterable[str]) -> tuple[int, ...]:
    return tuple(map(id_of_name, names))
