# SPDX-License-Identifier: BSD-3-Clause
"""The log of a map's edits, and taking them back."""
from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime, timezone

from dhpmap._call import Caller, new_request_id
from dhpmap._edit import ids
from dhpmap._objects import ObjectLike, submap_name
from dhpmap.v1 import edit_service_pb2 as pb2


@dataclass(frozen=True, slots=True)
class Undone:
    """What undoing, doing again or restoring did: edits by their revisions, objects by their ids."""

    revision: int
    edits: tuple[int, ...]
    changed: tuple[int, ...]
    created: tuple[int, ...]
    removed: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class LoggedEdit:
    """An edit of the log.

    Attributes:
        time: UTC.
        kind: "edit", "undo" or "redo".
        actions: such as "move".
        is_reversible: what it takes to undo it is kept.
    """

    revision: int
    time: datetime
    author: str
    kind: str
    actions: tuple[str, ...]
    changed: tuple[int, ...]
    created: tuple[int, ...]
    removed: tuple[int, ...]
    is_undone: bool
    is_reversible: bool

    def __str__(self) -> str:
        what = ", ".join(self.actions) or self.kind
        return f"revision {self.revision}: {what} by {self.author or 'nobody'}" + (", undone" if self.is_undone else "")


def undo(caller: Caller, map_name: str, author: str, count: int, revision: int | None) -> Undone:
    request = pb2.UndoEditsRequest(map=map_name, author=author, count=count, request_id=new_request_id())
    if revision is not None:
        request.edit, request.count = f"{map_name}/edits/{revision}", 0
    return _read(caller.unary("EditService/UndoEdits", request, pb2.UndoEditsResponse))


def redo(caller: Caller, map_name: str, author: str, count: int, revision: int | None) -> Undone:
    request = pb2.RedoEditsRequest(map=map_name, author=author, count=count, request_id=new_request_id())
    if revision is not None:
        request.edit, request.count = f"{map_name}/edits/{revision}", 0
    return _read(caller.unary("EditService/RedoEdits", request, pb2.RedoEditsResponse))


def restore(caller: Caller, map_name: str, author: str, revision: int, thing: ObjectLike | None) -> Undone:
    request = pb2.RestoreRevisionRequest(map=map_name, author=author, revision=revision, request_id=new_request_id())
    if thing is not None:
        request.submap = submap_name(map_name, thing)
    answer = caller.unary("EditService/RestoreRevision", request, pb2.RestoreRevisionResponse)
    return Undone(answer.revision, (), ids(answer.changed_submaps), ids(answer.created_submaps),
                  ids(answer.removed_submaps))


def _read(answer: pb2.UndoEditsResponse | pb2.RedoEditsResponse) -> Undone:
    return Undone(answer.revision, ids(answer.edits), ids(answer.changed_submaps), ids(answer.created_submaps),
                  ids(answer.removed_submaps))


def logged_edits(caller: Caller, map_name: str, author: str) -> Iterator[LoggedEdit]:
    request = pb2.ListEditsRequest(parent=map_name, author=author)
    while True:
        page = caller.unary("EditService/ListEdits", request, pb2.ListEditsResponse)
        yield from map(_read_logged, page.edits)
        if not page.next_page_token:
            return
        request.page_token = page.next_page_token


def _read_logged(edit: pb2.LoggedEdit) -> LoggedEdit:
    actions = tuple(pb2.LoggedEdit.Action.Name(step.action).lower() for step in edit.steps)
    return LoggedEdit(edit.revision, edit.create_time.ToDatetime(timezone.utc), edit.author,
                      pb2.LoggedEdit.Kind.Name(edit.kind).lower(), actions, ids(edit.changed_submaps),
                      ids(edit.created_submaps), ids(edit.removed_submaps), edit.undone, edit.reversible)
