# SPDX-License-Identifier: BSD-3-Clause
"""What a server says of a map as a whole, and of who feeds it."""
from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime, timezone
from typing import Literal

from google.protobuf import field_mask_pb2

from dhpmap._call import Caller, new_request_id
from dhpmap._errors import bad_argument
from dhpmap._objects import KINDS
from dhpmap.v1 import map_service_pb2, mapping_service_pb2, types_pb2

_KIND_NUMBERS = {"thing": types_pb2.LabelClass.THING, "stuff": types_pb2.LabelClass.STUFF}
_SIZES = {"small": types_pb2.LabelClass.SMALL, "medium": types_pb2.LabelClass.MEDIUM,
          "large": types_pb2.LabelClass.LARGE}
_SIZE_NAMES = {number: name for name, number in _SIZES.items()}


@dataclass(frozen=True, slots=True)
class Label:
    """A class of a map's label set. A thing is countable, an object each; stuff is background, an object a class.

    Attributes:
        id: 0 to 65534.
        size: decides how many points a new object needs.
    """

    id: int
    name: str
    kind: Literal["thing", "stuff"] = "thing"
    size: Literal["small", "medium", "large"] = "medium"


@dataclass(frozen=True, slots=True)
class MapInfo:
    """A map as a whole, at one revision.

    Attributes:
        num_objects: the unknown object 0 is none.
        history_id: another one for each map that is made or restored.
    """

    name: str
    title: str
    revision: int
    num_frames: int
    num_objects: int
    voxel_size_m: float
    classes: tuple[Label, ...]
    history_id: str
    etag: str


@dataclass(frozen=True, slots=True)
class Session:
    """One session of frames.

    Attributes:
        num_frames: fused since the map was opened.
        frames_per_s: over the last 10 s.
    """

    name: str
    is_feeding: bool
    num_frames: int
    num_refused: int
    frames_per_s: float
    stored_sequence: int | None


@dataclass(frozen=True, slots=True)
class Finished:
    """What finishing has left."""

    revision: int
    num_frames: int
    num_objects: int


@dataclass(frozen=True, slots=True)
class Verified:
    """What looking through all that is stored has found.

    Attributes:
        faults: the first 1,000: what was found, or dropped.
    """

    revision: int
    num_objects: int
    num_faults: int
    faults: tuple[str, ...]
    repaired: bool

    def __bool__(self) -> bool:
        return self.num_faults == 0


@dataclass(frozen=True, slots=True)
class Revision:
    """A state of a map that can be read by `Map.at`; time: UTC, when it was last changed."""

    revision: int
    time: datetime


@dataclass(frozen=True, slots=True)
class MapStats:
    """What a map holds and what it costs.

    Attributes:
        num_active: of the things.
        disk_bytes: of encoded blocks in the store.
    """

    revision: int
    num_frames: int
    num_things: int
    num_stuff: int
    num_active: int
    num_observed_voxels: int
    memory_bytes: int
    disk_bytes: int


def label_message(label: Label) -> types_pb2.LabelClass:
    if label.kind not in _KIND_NUMBERS or label.size not in _SIZES:
        raise bad_argument("labels", f"{label!r} has another kind than {', '.join(_KIND_NUMBERS)}, "
                                     f"or another size than {', '.join(_SIZES)}")
    return types_pb2.LabelClass(id=label.id, name=label.name, kind=_KIND_NUMBERS[label.kind], size=_SIZES[label.size])


def read_info(message: types_pb2.Map) -> MapInfo:
    classes = tuple(Label(its.id, its.name, "stuff" if KINDS.get(its.kind) == "stuff" else "thing",
                          _size(its.size)) for its in message.label_classes)
    return MapInfo(message.name.removeprefix("maps/"), message.display_name, message.revision, message.num_frames,
                   max(message.num_submaps - 1, 0), message.config.voxel_size_m, classes, message.history_id,
                   message.etag)


def _size(number: int) -> Literal["small", "medium", "large"]:
    if number == types_pb2.LabelClass.SMALL:
        return "small"
    return "large" if number == types_pb2.LabelClass.LARGE else "medium"


def map_info(caller: Caller, map_name: str) -> MapInfo:
    request = map_service_pb2.GetMapRequest(name=map_name)
    return read_info(caller.unary("MapService/GetMap", request, map_service_pb2.GetMapResponse).map)


def session_messages(caller: Caller, map_name: str) -> Iterator[mapping_service_pb2.FeedSession]:
    request = mapping_service_pb2.ListSessionsRequest(parent=map_name)
    while True:
        page = caller.unary("MappingService/ListSessions", request, mapping_service_pb2.ListSessionsResponse)
        yield from page.sessions
        if not page.next_page_token:
            return
        request.page_token = page.next_page_token


def sessions(caller: Caller, map_name: str) -> list[Session]:
    return [Session(its.session, its.feeding, its.num_frames, its.num_refused, its.frames_per_s,
                    its.committed_sequence if its.HasField("committed_sequence") else None)
            for its in session_messages(caller, map_name)]


def revisions(caller: Caller, map_name: str) -> Iterator[Revision]:
    request = map_service_pb2.ListMapRevisionsRequest(parent=map_name)
    while True:
        page = caller.unary("MapService/ListMapRevisions", request, map_service_pb2.ListMapRevisionsResponse)
        for its in page.revisions:
            yield Revision(its.revision, its.update_time.ToDatetime(timezone.utc))
        if not page.next_page_token:
            return
        request.page_token = page.next_page_token


def map_stats(caller: Caller, map_name: str) -> MapStats:
    request = map_service_pb2.GetMapStatsRequest(name=map_name)
    its = caller.unary("MapService/GetMapStats", request, map_service_pb2.GetMapStatsResponse)
    return MapStats(its.revision, its.num_frames, its.num_things, its.num_stuff, its.num_active,
                    its.num_observed_voxels, its.memory_bytes, its.disk_bytes)


def end_session(caller: Caller, map_name: str, session: str) -> None:
    request = mapping_service_pb2.EndSessionRequest(map=map_name, session=session)
    caller.unary("MappingService/EndSession", request, mapping_service_pb2.EndSessionResponse)


def set_title(caller: Caller, map_name: str, title: str, author: str) -> None:
    request = map_service_pb2.UpdateMapRequest(
        map=types_pb2.Map(name=map_name, display_name=title), author=author, request_id=new_request_id(),
        update_mask=field_mask_pb2.FieldMask(paths=["display_name"]))
    caller.unary("MapService/UpdateMap", request, map_service_pb2.UpdateMapResponse)


def verify(caller: Caller, map_name: str, repair: bool, deadline_s: float) -> Verified:
    request = map_service_pb2.VerifyMapRequest(name=map_name, repair=repair)
    answer = caller.unary("MapService/VerifyMap", request, map_service_pb2.VerifyMapResponse, deadline_s=deadline_s)
    return Verified(answer.revision, max(answer.num_submaps - 1, 0), answer.num_faults,
                    tuple(f"{its.location} {its.description}" for its in answer.faults), answer.repaired)


def finish_mapping(caller: Caller, map_name: str, deadline_s: float) -> Finished:
    request = mapping_service_pb2.FinishMappingRequest(map=map_name)
    answer = caller.unary("MappingService/FinishMapping", request, mapping_service_pb2.FinishMappingResponse,
                          deadline_s=deadline_s)
    return Finished(answer.revision, answer.num_frames, max(answer.num_submaps - 1, 0))
