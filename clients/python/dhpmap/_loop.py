# SPDX-License-Identifier: BSD-3-Clause
"""Queries on one stream, for control loops."""
from __future__ import annotations

import itertools
import queue
import threading
import time
from collections.abc import Iterator

import grpc
from google.protobuf.message import Message

from dhpmap._call import Caller, is_passing, pauses
from dhpmap._errors import DeadlineExceeded, Error, Unavailable, error_of, error_of_rpc
from dhpmap._view import Queries
from dhpmap._wire import bytes_field, walk
from dhpmap.v1 import query_service_pb2 as pb2
from dhpmap.v1 import rpc_status_pb2

_FIELD_OF = {field.message_type.full_name: field.name
             for field in pb2.StreamQueriesRequest.DESCRIPTOR.oneofs_by_name["query"].fields}


class StreamSource:
    """Asks on a StreamQueries, one query after the other. Opens it anew after a lost connection, pinned as before."""

    def __init__(self, caller: Caller, map_name: str) -> None:
        self.map_name, self.read_revision = map_name, 0
        self._caller = caller
        self._numbers = itertools.count(1)
        self._requests: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self._answers: queue.SimpleQueue[bytes | Error] = queue.SimpleQueue()
        self._call: grpc.Call | None = None
        self.pinned_revision = 0

    def answer(self, query: type[Message], request: bytes, *, deadline_s: float | None = None) -> bytes:
        end = time.monotonic() + (self._caller.deadline_s if deadline_s is None else deadline_s)
        is_lost = False
        for pause_s in pauses():
            try:
                if self._call is None:
                    self._open(end, keeps_pin=query is not pb2.PinRequest, waits=is_lost)
                return self._exchange(_FIELD_OF[query.DESCRIPTOR.full_name], request, end)
            except Error as error:
                is_lost = isinstance(error, Unavailable)
                if isinstance(error, DeadlineExceeded) and not error.reason:
                    self.close()
                if not is_passing(error) or time.monotonic() + pause_s >= end:
                    raise
            time.sleep(pause_s)
        raise AssertionError("unreachable")

    def pin(self, revision: int, deadline_s: float | None) -> int:
        pin = pb2.PinRequest(map=self.map_name if revision >= 0 else "", read_revision=max(revision, 0))
        data = self.answer(pb2.PinRequest, pin.SerializeToString(), deadline_s=deadline_s)
        self.pinned_revision = pb2.PinResponse.FromString(data).revision
        return self.pinned_revision

    def close(self) -> None:
        self._requests.put(None)
        if self._call is not None:
            self._call.cancel()
            self._call = None

    def _open(self, end: float, keeps_pin: bool, waits: bool) -> None:
        self._requests, self._answers = queue.SimpleQueue(), queue.SimpleQueue()
        opened = self._caller.open("QueryService/StreamQueries", "stream_stream")
        self._call = opened(iter(self._requests.get, None), metadata=self._caller.metadata, wait_for_ready=waits)
        threading.Thread(target=_read_all, args=(self._call, self._answers, self._caller.address), daemon=True).start()
        if self.pinned_revision and keeps_pin:
            pin = pb2.PinRequest(map=self.map_name, read_revision=self.pinned_revision)
            try:
                self._exchange("pin", pin.SerializeToString(), end)
            except Error:
                self.close()  # or the next query would be of another state
                raise

    def _exchange(self, name: str, request: bytes, end: float) -> bytes:
        number = next(self._numbers)
        head = pb2.StreamQueriesRequest(sequence=number)
        self._requests.put(head.SerializeToString() + bytes_field(head.DESCRIPTOR, name, request))
        while True:
            try:
                got = self._answers.get(timeout=max(end - time.monotonic(), 0.001))
            except queue.Empty:
                raise DeadlineExceeded(f"the answer to {name} took longer than the deadline") from None
            if isinstance(got, Error):  # the stream is over
                self.close()
                raise got
            answered, data, error = _read(got)
            if answered != number:
                continue  # of a query that was given up
            if error is not None:
                raise error
            return data


class Loop(Queries):
    """Queries of one map on one stream: less to do a query than by calls. For one thread.

    `pin()` keeps to one state of the map; close it, or use it in a `with` block.
    """

    _source: StreamSource

    def __init__(self, caller: Caller, map_name: str) -> None:
        super().__init__(StreamSource(caller, map_name))

    def pin(self, revision: int = 0, *, deadline_s: float | None = None) -> int:
        """From here on queries are of the present state, or of a past revision, for 10 s at most; the revision."""
        return self._source.pin(revision, deadline_s)

    def unpin(self) -> None:
        """Queries are of the present again."""
        self._source.pin(-1, None)

    def close(self) -> None:
        self._source.close()

    def __enter__(self) -> Loop:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _read(data: bytes) -> tuple[int, bytes, Error | None]:
    """The number, the answer and the error in its place."""
    fields = pb2.StreamQueriesResponse.DESCRIPTOR.fields_by_name
    number, answer, error = 0, b"", None
    for field, _, value, piece in walk(memoryview(data)):
        if field == fields["sequence"].number:
            number = value
        elif field == fields["error"].number:
            status = rpc_status_pb2.Status.FromString(bytes(piece))
            error = error_of(status.code, status.message, bytes(piece))
        else:
            answer = bytes(piece)
    return number, answer, error


def _read_all(call: Iterator[bytes], answers: queue.SimpleQueue[bytes | Error], address: str) -> None:
    try:
        for answer in call:
            answers.put(answer)
        answers.put(Unavailable("the server has ended the stream"))
    except grpc.RpcError as failed:
        answers.put(error_of_rpc(failed, address))
