# SPDX-License-Identifier: BSD-3-Clause
"""What becomes of a map, as it is stored."""
from __future__ import annotations

import asyncio
import queue
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass

import grpc

from dhpmap._call import Caller, pauses
from dhpmap._errors import Error, Unavailable, error_of_rpc
from dhpmap._objects import Object, Ref, id_of_name, read_object
from dhpmap._shapes import Box, read_box
from dhpmap.v1 import watch_service_pb2 as pb2

PROGRESS_S = 5.0  # the server says something at least so often
MOST_WAITING = 1000


@dataclass(frozen=True, eq=False, slots=True)
class Change:
    """What became of one object.

    Attributes:
        kind: "created", "changed", "removed" or "merged".
        parts: of changed: "pose", "labels", "name", "activity", "geometry", ...
        object: as it is at `revision`; one that is gone, as it was.
        revision: up to which this is told.
        merged_into: of merged.
        boxes: of changed: where its surface has, in the map frame.
        position: where to go on after this: watch(resume_after=...). Moves with the last object of a revision.
    """

    kind: str
    parts: tuple[str, ...]
    object: Object
    revision: int
    merged_into: Ref | None
    boxes: tuple[Box, ...]
    position: str

    def __str__(self) -> str:
        what = f" ({', '.join(self.parts)})" if self.parts else ""
        into = f" into {self.merged_into.id}" if self.merged_into else ""
        return f"revision {self.revision}: {self.object} {self.kind}{into}{what}"


class Watch(Iterator[Change]):
    """Goes on until it is closed; a lost connection, or a server that starts anew, is waited for.

    Iterating raises OutOfRange (reason COMPACTED or HISTORY_LOST) where the changes are no longer kept: list the map,
    and watch anew. Close it, or use it in a `with` block, to end it; another thread may do so.

    `async for` waits on a thread of asyncio's. A task that is cancelled while it waits closes the watch; go on where it
    was by watch(resume_after=) of the last change's position.
    """

    def __init__(self, caller: Caller, request: pb2.WatchMapRequest, *, reconnect_s: float,
                 idle_s: float | None) -> None:
        self._caller, self._request = caller, request
        self._request.progress_interval_s = PROGRESS_S
        self._reconnect_s, self._idle_s = reconnect_s, idle_s
        self._told: list[Change] = []
        self._pending: list[Change] = []  # of a change whose last message has not come
        self._answers: queue.Queue[bytes | Error | None] = queue.Queue(MOST_WAITING)
        self._call: grpc.Call | None = None
        self._is_closed = False
        self._position = request.resume_after
        self.revision = 0  # everything up to this is told

    def __next__(self) -> Change:
        last = time.monotonic()
        while not self._told:
            if self._is_closed:
                raise StopIteration
            message = self._next_message(last)
            if message is None:
                self.close()
                raise StopIteration
            self._take(message)
        return self._told.pop(0)

    def __aiter__(self) -> Watch:
        return self

    async def __anext__(self) -> Change:
        try:
            change = await asyncio.to_thread(lambda: next(self, None))
        except asyncio.CancelledError:
            self.close()  # or the thread would wait on, and take a change that nobody gets
            raise
        if change is None:
            raise StopAsyncIteration
        return change

    def _next_message(self, since: float) -> pb2.WatchMapResponse | None:
        """None: nothing has changed for idle_s."""
        lost_at, pause = None, pauses()
        while True:
            if self._call is None:
                self._start()
            if self._is_closed:  # by another thread, which may have seen no call to cancel
                self._stop()
                return None
            wait_s = 3 * PROGRESS_S
            if self._idle_s is not None:
                wait_s = min(wait_s, since + self._idle_s - time.monotonic())
            try:
                got = self._answers.get(timeout=max(wait_s, 0.001))
            except queue.Empty:
                if self._idle_s is not None and time.monotonic() - since >= self._idle_s:
                    return None
                got = Unavailable(f"nothing came from the server for {3 * PROGRESS_S:g} s")
            if isinstance(got, bytes):
                return pb2.WatchMapResponse.FromString(got)
            if got is None or self._is_closed:
                return None
            now = time.monotonic()
            lost_at = lost_at if lost_at is not None else now
            if not isinstance(got, Unavailable) or now - lost_at > self._reconnect_s:
                self.close()
                raise got
            self._stop()
            self._caller.await_connection(next(pause))

    def _take(self, message: pb2.WatchMapResponse) -> None:
        if message.position:
            self._position = message.position
        if message.HasField("change"):
            self._pending += [_read_change(event, message) for event in message.change.submaps]
            if message.change.last_message:
                self.revision = message.change.last_revision
                self._told += self._pending
                self._pending = []
        elif message.HasField("progress"):
            self.revision = max(self.revision, message.progress.revision)

    def _start(self) -> None:
        self._pending = []  # comes again, from the first message on
        if self._position:
            self._request.resume_after = self._position
        open_stream = self._caller.open("WatchService/WatchMap", "unary_stream")
        call = open_stream(self._request.SerializeToString(), metadata=self._caller.metadata)
        answers: queue.Queue[bytes | Error | None] = queue.Queue(MOST_WAITING)
        self._call, self._answers = call, answers
        threading.Thread(target=_read_all, args=(call, answers, self._caller.address), daemon=True).start()

    def _stop(self) -> None:
        call, self._call = self._call, None  # close() may come from another thread
        if call is not None:
            call.cancel()

    def close(self) -> None:
        """Ends it: `for` loops over it end."""
        self._is_closed = True
        self._stop()
        try:
            self._answers.put_nowait(None)
        except queue.Full:
            pass

    def __enter__(self) -> Watch:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __del__(self) -> None:
        self.close()  # or its thread would read on


def _read_all(call: grpc.Call, answers: queue.Queue[bytes | Error | None], address: str) -> None:
    """On a thread of its own. A consumer that has gone on without it has cancelled the call."""
    try:
        for answer in call:
            while not _put(answers, answer):
                if not call.is_active():
                    return
        end: Error = Unavailable("the server has ended the watch")
    except grpc.RpcError as failed:
        end = error_of_rpc(failed, address)
    _put(answers, end)  # into a queue that stays full: found out by the silence


def _put(answers: queue.Queue[bytes | Error | None], answer: bytes | Error) -> bool:
    try:
        answers.put(answer, timeout=1)
    except queue.Full:
        return False
    return True


def _read_change(event: pb2.SubmapEvent, message: pb2.WatchMapResponse) -> Change:
    return Change(
        pb2.SubmapEvent.Kind.Name(event.kind).lower(),
        tuple(pb2.SubmapEvent.Part.Name(part).lower() for part in event.parts), read_object(event.submap),
        message.change.last_revision, Ref(id_of_name(event.merged_into)) if event.merged_into else None,
        tuple(map(read_box, event.boxes)), message.position)
