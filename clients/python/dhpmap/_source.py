# SPDX-License-Identifier: BSD-3-Clause
"""Where a query goes: to a map, now or as it was at a revision, by a call or on a stream."""
from __future__ import annotations

from typing import Protocol, TypeVar

from google.protobuf.message import Message

from dhpmap._call import Caller
from dhpmap.v1 import query_options_pb2

Answer = TypeVar("Answer", bound=Message)


class Source(Protocol):
    """A map to ask."""

    map_name: str       # maps/{map}
    read_revision: int  # 0: the present state

    def answer(self, query: type[Message], request: bytes, *, deadline_s: float | None = None) -> bytes:
        """The answer to a serialised request of QueryService."""


class CalledSource:
    """Asks by one call a query."""

    def __init__(self, caller: Caller, map_name: str, read_revision: int = 0) -> None:
        self.caller = caller
        self.map_name = map_name
        self.read_revision = read_revision

    def answer(self, query: type[Message], request: bytes, *, deadline_s: float | None = None) -> bytes:
        method = query.DESCRIPTOR.name.removesuffix("Request")
        return self.caller.raw(f"QueryService/{method}", request, deadline_s=deadline_s)


class EventualSource(CalledSource):
    """The same of the state that the server which is asked has."""

    def answer(self, query: type[Message], request: bytes, *, deadline_s: float | None = None) -> bytes:
        # What comes later in a message stands for what comes before.
        eventual = query()
        setattr(eventual, "consistency", query_options_pb2.Consistency.EVENTUAL)
        return super().answer(query, request + eventual.SerializeToString(), deadline_s=deadline_s)


def ask(source: Source, request: Message, answer: type[Answer], *, deadline_s: float | None = None) -> Answer:
    """The same with messages."""
    return answer.FromString(source.answer(type(request), request.SerializeToString(), deadline_s=deadline_s))
