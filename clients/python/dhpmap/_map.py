# SPDX-License-Identifier: BSD-3-Clause
"""A map of a server."""
from __future__ import annotations

import os
import pathlib
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Unpack

from numpy.typing import ArrayLike

from dhpmap._call import Caller
from dhpmap._camera import Camera
from dhpmap._edit import Edit
from dhpmap._errors import bad_argument
from dhpmap._feed import Feed
from dhpmap._files import write_parts
from dhpmap._history import LoggedEdit, Undone, logged_edits, redo, restore, undo
from dhpmap._loop import Loop
from dhpmap._map_info import (Finished, MapInfo, MapStats, Revision, Session, Verified, end_session, finish_mapping,
                              map_info, map_stats, revisions, sessions, set_title, verify)
from dhpmap._map_view import EventualMap, MapView, PastMap
from dhpmap._objects import ObjectLike, id_of
from dhpmap._options import strings
from dhpmap._shapes import Box, box_message
from dhpmap._watch import Watch
from dhpmap.v1 import map_service_pb2, watch_service_pb2

if TYPE_CHECKING:
    from dhpmap.mcap import Fed, FrameOptions


class Map(MapView):
    """A map of a server, as it is whenever it is asked. Safe for use from several threads."""

    def __init__(self, caller: Caller, map_name: str, author: str = "") -> None:
        super().__init__(caller, map_name)
        self._author = author

    @property
    def info(self) -> MapInfo:
        """Revision, counts, classes and settings, as they are now."""
        return map_info(self._caller, self.resource_name)

    def at(self, revision: int) -> PastMap:
        """The map as it was at a revision of the recent past, to be asked likewise."""
        if revision < 1:
            raise bad_argument("revision", f"{revision} is none; the present state is that of the map itself")
        return PastMap(self._caller, self.resource_name, revision)

    def eventual(self) -> EventualMap:
        """The map as the server that is asked has it, where several servers share a store.

        That is a copy, some tenths of a second behind the server that writes the map. Answers never go back in time;
        with `min_revision` they wait until the copy is there.
        """
        return EventualMap(self._caller, self.resource_name)

    def revisions(self) -> list[Revision]:
        """Those that `at` can read now, the newest first."""
        return list(revisions(self._caller, self.resource_name))

    def loop(self) -> Loop:
        """Queries on one stream, for control loops: less to do a query, and `pin()` keeps to one state."""
        return Loop(self._caller, self.resource_name)

    def stats(self) -> MapStats:
        """What the map holds and what it costs."""
        return map_stats(self._caller, self.resource_name)

    def edit(self, *, author: str | None = None, expected_revision: int = 0, only_if_unedited: bool = False,
             deadline_s: float | None = None) -> Edit:
        """Collects edits in a `with` block, and does them all as one revision when it is left.

        expected_revision: Aborted (reason EDITED_SINCE) if what they name was edited after it. only_if_unedited:
        Aborted (reason ETAG_MISMATCH) if an Object that is passed has been edited since it was got.
        """
        self._author = self._author if author is None else author
        return Edit(self._caller, self.resource_name, author=self._author, expected_revision=expected_revision,
                    only_if_unedited=only_if_unedited, deadline_s=deadline_s)

    def undo(self, count: int = 1, *, author: str | None = None, revision: int | None = None) -> Undone:
        """Takes the last edits of an author back: by default, who edited last through this object.

        revision: that edit instead, whoever made it. Aborted (reason UNDO_CONFLICT) where others have changed the same
        since; FailedPrecondition (reason NOTHING_TO_UNDO).
        """
        return undo(self._caller, self.resource_name, self._author if author is None else author, count, revision)

    def redo(self, count: int = 1, *, author: str | None = None, revision: int | None = None) -> Undone:
        """Does again what was undone."""
        return redo(self._caller, self.resource_name, self._author if author is None else author, count, revision)

    def restore(self, revision: int, thing: ObjectLike | None = None, *, author: str | None = None) -> Undone:
        """Takes the map, or one object, back to a revision of the recent past, as an edit that can be undone."""
        return restore(self._caller, self.resource_name, self._author if author is None else author, revision, thing)

    def log(self, *, author: str = "") -> Iterator[LoggedEdit]:
        """All edits, or those of an author, the newest first."""
        return logged_edits(self._caller, self.resource_name, author)

    def watch(self, *, objects: Iterable[ObjectLike] = (), classes: Iterable[str] = (), region: Box | None = None,
              after_revision: int | None = None, resume_after: str = "", idle_s: float | None = None,
              reconnect_s: float = 300) -> Watch:
        """What becomes of objects, as it is stored; of some, or within a box in the map frame.

        after_revision: begin after it, such as that of a list; resume_after: after the `position` of a Change; else
        from now on. Ends once nothing was told for idle_s; by default never.
        """
        request = watch_service_pb2.WatchMapRequest(map=self.resource_name, resume_after=resume_after)
        request.filter.instance_ids.extend(id_of(one, self.resource_name) for one in objects)
        request.filter.class_names.extend(strings("classes", classes))
        if region is not None:
            request.filter.region.CopyFrom(box_message(region))
        if after_revision is not None:
            request.start_revision = after_revision + 1
        return Watch(self._caller, request, reconnect_s=reconnect_s, idle_s=idle_s)

    def feed(self, session: str, *, camera: Camera | ArrayLike | None = None, depth_scale_m: float | None = None,
             persistent_ids: bool = False, take_over: bool = False, refuse_implausible: bool = False,
             reconnect_s: float = 60, memory_mib: int = 512, deadline_s: float = 60,
             progress: bool | int = False) -> Feed:
        """Feeds frames in a session, whose name is the robot's: 1 to 64 of A-Z a-z 0-9 . _ -.

        camera: of `rgbd`, a Camera or a 3 x 3 matrix for images as large as the depth images.
        depth_scale_m: metres a unit of uint16 depth. persistent_ids: a segment's id means the same object in every
        frame. take_over: ends all that feed the map now. refuse_implausible: frames are refused rather than warned of.
        progress: a bar of tqdm, where it is installed; or how many frames there will be.
        Raises Aborted (reason MAP_IS_FED) if a stream without a session feeds the map.
        """
        class_ids = {its.name: its.id for its in self.info.classes}
        return Feed(self._caller, self.resource_name, session, camera=camera, class_ids=class_ids,
                    depth_scale_m=depth_scale_m, persistent_ids=persistent_ids, take_over=take_over,
                    refuse_implausible=refuse_implausible, reconnect_s=reconnect_s, memory_mib=memory_mib,
                    deadline_s=deadline_s, progress=progress)

    def feed_mcap(self, path: str | os.PathLike[str], session: str, *, persistent_ids: bool = False,
                  take_over: bool = False, refuse_implausible: bool = False, progress: bool = False,
                  **options: Unpack[FrameOptions]) -> Fed:
        """Feeds a recording of ROS 2, an MCAP file or a folder of them; returns once all is stored.

        options: of dhpmap.mcap.FrameOptions, such as depth="/camera/depth/image"; the others as of `feed`.
        Raises what dhpmap.mcap.frames and its frames do, and what Feed does; what was fed before that stays.
        """
        from dhpmap.mcap._feed import feed_mcap
        return feed_mcap(self, path, session, persistent_ids=persistent_ids, take_over=take_over,
                         refuse_implausible=refuse_implausible, progress=progress, **options)

    def export(self, path: str | pathlib.Path, *, deadline_s: float = 3600) -> int:
        """Writes the map as it is stored into a file, which Server.import_map takes; its bytes."""
        request = map_service_pb2.ExportMapRequest(name=self.resource_name)
        return write_parts(path, self._caller.stream("MapService/ExportMap", request, map_service_pb2.ExportMapResponse,
                                                     deadline_s=deadline_s))

    def verify(self, *, repair: bool = False, deadline_s: float = 3600) -> Verified:
        """Looks through all that is stored; repair: drops what cannot be read, unless the map is open."""
        return verify(self._caller, self.resource_name, repair, deadline_s)

    def set_title(self, title: str, *, author: str | None = None) -> None:
        """What people call the map."""
        set_title(self._caller, self.resource_name, title, self._author if author is None else author)

    def end_session(self, session: str) -> None:
        """Ends the stream that feeds the map in a session. NotFound (reason SESSION_NOT_FOUND) if there is none."""
        end_session(self._caller, self.resource_name, session)

    def sessions(self) -> list[Session]:
        """Who feeds the map, or has fed it."""
        return sessions(self._caller, self.resource_name)

    def finish_mapping(self, *, deadline_s: float = 3600) -> Finished:
        """Settles all things and refines labels; takes up to minutes. Mapping may go on later."""
        return finish_mapping(self._caller, self.resource_name, deadline_s)

    def __repr__(self) -> str:
        return f"<dhpmap.Map {self.name} of {self._caller.address}>"

    def __str__(self) -> str:
        info = self.info
        fed_by = [its.name or "an unnamed stream" for its in self.sessions() if its.is_feeding]
        return (f"{info.title or self.name}: {info.num_objects} objects, {info.num_frames} frames, "
                f"revision {info.revision}, " + (f"fed by {', '.join(fed_by)}" if fed_by else "nobody feeds it"))

    def _repr_html_(self) -> str:
        from dhpmap._show import map_html
        return map_html(self)
