# SPDX-License-Identifier: BSD-3-Clause
"""A session of frames: sent in order, kept until they are stored, sent again after a lost connection."""
from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Iterator

import grpc

from dhpmap._call import Caller, pauses
from dhpmap._errors import (DeadlineExceeded, Error, FailedPrecondition, ResourceExhausted, Unavailable, error_of_rpc,
                            error_of_status)
from dhpmap._wire import bytes_field
from dhpmap.v1 import mapping_service_pb2 as pb2

MOST_UNACKNOWLEDGED = 8
MOST_KEPT_ANSWERS = 1000
_PASSING = ("STORE_BEHIND", "TOO_MANY_BYTES")  # the same frame may be taken a little later


class FrameStream:
    """Safe for one thread that pushes, and any that look. A thread of its own holds the connection."""

    def __init__(self, caller: Caller, map_name: str, session: str, *, take_over: bool, refuse_implausible: bool,
                 reconnect_s: float, memory_bytes: int) -> None:
        self._caller = caller
        self._greeting = pb2.IntegrateFramesRequest(map=map_name, session=session, take_over=take_over,
                                                    refuse_implausible=refuse_implausible)
        self._reconnect_s, self._memory_bytes = reconnect_s, memory_bytes
        self._changed = threading.Condition()
        self._kept: dict[int, bytes] = {}  # by sequence, ascending: what is not known to be stored
        self._kept_bytes = 0
        self._unacknowledged: set[int] = set()
        self._unsent: deque[int] = deque()  # on this connection
        self._connection = 0    # counted, so that what is left of an old one ends
        self._is_greeted = False
        self._is_flushing = False  # ends the connection in good order, for only then the server stores at once
        self._is_closing = False
        self._is_abandoned = False
        self._call: grpc.Call | None = None
        self._is_over = False
        self._error: Error | None = None
        self._commit_error: Error = Unavailable("frames are fused, but the server does not say that they are stored")
        self._heard_at = time.monotonic()
        self.stored_sequence: int | None = None
        self.num_fused = 0
        self.told: deque[pb2.IntegrateFramesResponse] = deque(maxlen=MOST_KEPT_ANSWERS)  # refusals and warnings
        self._thread = threading.Thread(target=self._run, name=f"feed {session}", daemon=True)
        self._thread.start()

    def wait_until_greeted(self, deadline_s: float) -> None:
        """Raises what the server refuses the stream with."""
        with self._changed:
            self._wait(lambda: self._is_greeted, deadline_s, "the session")

    def push(self, sequence: int, frame: bytes, deadline_s: float) -> None:
        """Waits for room; raises what has ended the stream."""
        def is_full() -> bool:
            return bool(self._kept) and self._kept_bytes + len(frame) > self._memory_bytes

        with self._changed:
            if self._is_closing or self._is_abandoned:
                raise FailedPrecondition("this feed is closed: open another one")
            if is_full():
                self._is_flushing = True
                self._changed.notify_all()
            self._wait(lambda: len(self._unacknowledged) < MOST_UNACKNOWLEDGED and not is_full(), deadline_s,
                       "room for a frame")
            self._kept[sequence] = frame
            self._kept_bytes += len(frame)
            self._unacknowledged.add(sequence)
            self._unsent.append(sequence)
            self._changed.notify_all()

    def close(self, deadline_s: float) -> None:
        """Waits until all is stored."""
        with self._changed:
            self._is_closing = True
            self._changed.notify_all()
            self._wait(lambda: self._is_over, deadline_s, "the end of the stream")

    def abandon(self) -> None:
        """Ends the connection at once; what is not stored may be lost."""
        with self._changed:
            self._is_abandoned = True
            if self._call is not None:
                self._call.cancel()

    def _wait(self, is_so: Callable[[], bool], deadline_s: float, what: str) -> None:
        """At most so long after the server's last word."""
        began_at = time.monotonic()
        while not is_so():
            if self._error is not None:
                raise self._error
            left_s = max(self._heard_at, began_at) + deadline_s - time.monotonic()
            if left_s <= 0:
                raise DeadlineExceeded(f"waited {deadline_s:g} s for {what}, and the server said nothing")
            self._changed.wait(left_s)
        if self._error is not None:
            raise self._error

    def _run(self) -> None:
        try:
            self._hold()
        except Exception as error:  # such as a channel that is closed meanwhile: whoever waits must hear of it
            with self._changed:
                self._error = error if isinstance(error, Error) else Unavailable(f"the feed has ended: {error!r}")
                self._changed.notify_all()

    def _hold(self) -> None:
        pause, lost_at = pauses(), None
        while True:
            heard_before = self._heard_at
            error = self._exchange()
            if self._heard_at != heard_before:
                pause, lost_at = pauses(), None
            with self._changed:
                is_over = error is None and self._is_closing and not self._unacknowledged
            if error is None and not is_over:
                continue  # all is stored, and there is more to come
            lost_at = lost_at if lost_at is not None else time.monotonic()
            # Without a reason it is gRPC's own word: the frame is larger than the server takes, and will be.
            passes = isinstance(error, Unavailable) or (isinstance(error, ResourceExhausted) and bool(error.reason))
            gave_up = not passes or time.monotonic() - lost_at > self._reconnect_s
            with self._changed:
                self._is_over = is_over
                self._error = error if gave_up else None
                self._changed.notify_all()
                if gave_up:
                    return
            self._caller.await_connection(next(pause))

    def _exchange(self) -> Error | None:
        """One connection; None: all is sent and stored."""
        with self._changed:
            self._connection += 1
            self._is_greeted = False
        open_stream = self._caller.open("MappingService/IntegrateFrames", "stream_stream")
        call = open_stream(self._requests(self._connection), metadata=self._caller.metadata)
        with self._changed:
            self._call = call
            if self._is_abandoned:
                call.cancel()
        try:
            for number, answer in enumerate(call):
                if number == 0:
                    self._caller.heard(call.initial_metadata() or ())
                error = self._hear(pb2.IntegrateFramesResponse.FromString(answer))
                if error is not None:
                    return error
        except grpc.RpcError as failed:
            self._caller.lost()
            return error_of_rpc(failed, self._caller.address)
        finally:
            call.cancel()
            with self._changed:
                self._connection += 1
                self._changed.notify_all()
        with self._changed:
            is_asked_for = self._is_closing or self._is_flushing
            self._is_flushing = False
            if is_asked_for and not self._unacknowledged:
                return self._commit_error if self._kept else None
        return Unavailable("the server has ended the stream")

    def _requests(self, connection: int) -> Iterator[bytes]:
        yield self._greeting.SerializeToString()
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._connection != connection
                                       or (self._is_greeted
                                           and bool(self._unsent or self._is_closing or self._is_flushing)))
                if self._connection != connection or not self._unsent:
                    return
                sequence = self._unsent.popleft()
                frame = self._kept.get(sequence)
            if frame is not None:
                head = pb2.IntegrateFramesRequest(sequence=sequence)
                yield head.SerializeToString() + bytes_field(head.DESCRIPTOR, "frame", frame)

    def _hear(self, answer: pb2.IntegrateFramesResponse) -> Error | None:
        with self._changed:
            self._heard_at = time.monotonic()
            if answer.HasField("commit_error"):
                self._commit_error = error_of_status(answer.commit_error, "frames are fused, but not stored: ")
            if answer.HasField("committed_sequence"):
                self._forget_stored(answer.committed_sequence)
            if not self._is_greeted:
                if answer.HasField("error"):
                    return error_of_status(answer.error)
                self._is_greeted = True
                self._greeting.take_over = False  # what takes over from us later may keep it
                self._unsent = deque(self._kept)
            elif answer.outcome != pb2.IntegrateFramesResponse.FRAME_OUTCOME_UNSPECIFIED:
                error = self._acknowledge(answer)
                if error is not None:
                    return error
            self._changed.notify_all()
        return None

    def _acknowledge(self, answer: pb2.IntegrateFramesResponse) -> Error | None:
        """What makes the frame come again on another connection: it was refused for now only."""
        if answer.outcome == pb2.IntegrateFramesResponse.REFUSED:
            error = error_of_status(answer.error)
            if isinstance(error, Unavailable) or error.reason in _PASSING:
                return error
        self._unacknowledged.discard(answer.sequence)
        if answer.outcome == pb2.IntegrateFramesResponse.FUSED:
            self.num_fused += 1
        elif answer.outcome == pb2.IntegrateFramesResponse.REFUSED:
            self._kept_bytes -= len(self._kept.pop(answer.sequence, b""))
        if answer.outcome == pb2.IntegrateFramesResponse.REFUSED or answer.warnings:
            self.told.append(answer)
        return None

    def _forget_stored(self, sequence: int) -> None:
        self.stored_sequence = sequence
        while self._kept and (first := next(iter(self._kept))) <= sequence:
            self._kept_bytes -= len(self._kept.pop(first))
            self._unacknowledged.discard(first)
