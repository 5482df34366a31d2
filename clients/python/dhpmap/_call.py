# SPDX-License-Identifier: BSD-3-Clause
"""The only caller of the server: deadlines, retries, errors."""
from __future__ import annotations

import time
import uuid
from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeVar

import grpc
from google.protobuf.message import Message

from dhpmap._errors import Aborted, DeadlineExceeded, Error, Unavailable, error_of_rpc

Answer = TypeVar("Answer", bound=Message)
Heard = Callable[[Iterable[Any]], None]  # is told the metadata that an answer begins with

FIRST_PAUSE_S = 0.1
CONNECT_S = 2.0  # longer than a server takes that starts anew
MOST_PAUSE_S = 2.0


def new_request_id() -> str:
    """By which the server knows an edit that is sent again."""
    return str(uuid.uuid4())


def pauses() -> Iterator[float]:
    """Seconds to wait before each attempt after the first."""
    pause_s = FIRST_PAUSE_S
    while True:
        yield pause_s
        pause_s = min(2 * pause_s, MOST_PAUSE_S)


class Caller:
    """Calls by name, such as "QueryService/QueryDistances". Safe for use from several threads."""

    def __init__(self, channel: grpc.Channel, address: str, deadline_s: float, token: str = "") -> None:
        self._channel = channel
        self.address = address
        self.deadline_s = deadline_s
        self.metadata = (("authorization", f"Bearer {token}"),) if token else ()

    def unary(self, method: str, request: Message, answer: type[Answer], *, deadline_s: float | None = None,
              again: bool = True) -> Answer:
        """The answer to one request; see `raw`."""
        return answer.FromString(self.raw(method, request.SerializeToString(), deadline_s=deadline_s, again=again))

    def raw(self, method: str, request: bytes, *, deadline_s: float | None = None, again: bool = True,
            heard: Heard | None = None) -> bytes:
        """The same in bytes. All attempts together end by the deadline.

        A call that met no server is sent again, unless `again` is False: for what would be done twice, as it carries
        no request_id.
        """
        call = self._channel.unary_unary(f"/dhpmap.v1.{method}")
        end = time.monotonic() + (self.deadline_s if deadline_s is None else deadline_s)
        lost: Error | None = None
        for pause_s in pauses():
            left_s = max(end - time.monotonic(), 0.0)
            try:
                # Who waits for a lost connection keeps gRPC at it, which looks every 5 s only while nobody does.
                answer: bytes
                answer, done = call.with_call(request, timeout=left_s, metadata=self.metadata,
                                              wait_for_ready=lost is not None)
                if heard is not None:
                    heard(done.initial_metadata() or ())
                return answer
            except grpc.RpcError as failed:
                error = error_of_rpc(failed, self.address)
            if lost is not None and isinstance(error, DeadlineExceeded) and not error.reason:
                raise self._told(lost, method, deadline_s) from None  # as far as anybody knows
            if isinstance(error, Unavailable):
                lost = error
            if not (again and is_passing(error)) or time.monotonic() + pause_s >= end:
                raise self._told(error, method, deadline_s) from None
            time.sleep(pause_s)
        raise AssertionError("unreachable")

    def _told(self, error: Error, method: str, deadline_s: float | None) -> Error:
        if isinstance(error, DeadlineExceeded) and not error.reason:
            took_s = self.deadline_s if deadline_s is None else deadline_s
            error.args = (f"{method.partition('/')[2]} took longer than deadline_s={took_s:g}",)
        return error

    def stream(self, method: str, request: Message, answer: type[Answer], *, deadline_s: float | None = None
               ) -> Iterator[Answer]:
        """The answers to one request, as they come, the last by the deadline."""
        return map(answer.FromString, self.raw_stream(method, request.SerializeToString(), deadline_s=deadline_s))

    def raw_stream(self, method: str, request: bytes, *, deadline_s: float | None = None) -> Iterator[bytes]:
        """The same in bytes."""
        call = self._channel.unary_stream(f"/dhpmap.v1.{method}")
        timeout_s = self.deadline_s if deadline_s is None else deadline_s
        answers = call(request, timeout=timeout_s, metadata=self.metadata)
        try:
            yield from answers
        except grpc.RpcError as failed:
            raise self._told(error_of_rpc(failed, self.address), method, deadline_s) from None
        finally:
            answers.cancel()

    def open(self, method: str, kind: str) -> Callable[..., Any]:
        """A stream without a deadline, of bytes both ways: "stream_stream", "unary_stream" or "stream_unary"."""
        opened: Callable[..., Any] = getattr(self._channel, kind)(f"/dhpmap.v1.{method}")
        return opened

    def heard(self, head: Iterable[Any]) -> None:
        """To be told the metadata of the first answer of what `open` has begun."""

    def lost(self) -> None:
        """To be told that what `open` has begun met no server, or none that would have it."""

    def follow(self, note: Callable[[grpc.ChannelConnectivity], None]) -> None:
        """Connects, and is told how that is, on a thread of gRPC."""
        self._channel.subscribe(note, try_to_connect=True)

    def is_ready(self, timeout_s: float) -> bool:
        """Waits until there is a connection."""
        ready = grpc.channel_ready_future(self._channel)
        try:
            ready.result(timeout=timeout_s)
        except grpc.FutureTimeoutError:
            return False
        finally:
            ready.cancel()  # or the channel tells it of each change for ever
        return True

    def await_connection(self, pause_s: float) -> None:
        """Pauses, then waits a while for a connection: gRPC looks every 5 s only at a channel that nobody waits for."""
        begun = time.monotonic()
        self.is_ready(max(pause_s, CONNECT_S))
        time.sleep(max(0.0, begun + pause_s - time.monotonic()))

    def close(self) -> None:
        self._channel.close()


def is_passing(error: Error) -> bool:
    """Whether the same request may be answered a little later."""
    return isinstance(error, Unavailable) or (isinstance(error, Aborted) and error.reason == "SNAPSHOT_EXPIRED")
