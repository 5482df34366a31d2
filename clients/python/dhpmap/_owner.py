# SPDX-License-Identifier: BSD-3-Clause
"""Of several servers on one database, the way to the one that owns a map."""
from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from typing import Any

import grpc

from dhpmap._call import Caller, Heard
from dhpmap._errors import Unavailable

OWNER_KEY = "dhpmap-owner"
MOST_SERVERS = 16


class Owners:
    """Connections to servers that answers have named. Safe for use from several threads."""

    def __init__(self, dial: Callable[[str], Caller | None]) -> None:
        self._dial = dial
        self._lock = threading.Lock()
        self._callers: dict[str, Caller] = {}
        self._ready: set[str] = set()

    def find(self, address: str) -> Caller | None:
        """That of an address once it is connected; begins to connect."""
        with self._lock:
            if address in self._callers:
                return self._callers[address] if address in self._ready else None
            caller = self._dial(address) if len(self._callers) < MOST_SERVERS else None
            if caller is None:
                return None
            self._callers[address] = caller
        caller.follow(lambda state: self._note(address, state))
        return None

    def _note(self, address: str, state: grpc.ChannelConnectivity) -> None:
        with self._lock:
            if state is grpc.ChannelConnectivity.READY:
                self._ready.add(address)
            else:
                self._ready.discard(address)

    def close(self) -> None:
        with self._lock:
            callers, self._callers = list(self._callers.values()), {}
        for caller in callers:
            caller.close()


class OwnerCaller(Caller):
    """Calls about one map: to its owner where that is known and connected, else by the first server, which passes them
    on. Safe for use from several threads."""

    def __init__(self, first: Caller, owners: Owners) -> None:  # pylint: disable=super-init-not-called
        self._first, self._owners = first, owners
        self._channel = first._channel
        self.address, self.deadline_s, self.metadata = first.address, first.deadline_s, first.metadata
        self._owner = ""  # its address

    def raw(self, method: str, request: bytes, *, deadline_s: float | None = None, again: bool = True,
            heard: Heard | None = None) -> bytes:
        owner = self._nearest()
        if owner is not None:
            try:
                return owner.raw(method, request, deadline_s=deadline_s, again=False, heard=self.heard)
            except Unavailable as error:
                self._owner = ""
                if not again and error.reason != "NOT_OWNER":
                    raise
        return self._first.raw(method, request, deadline_s=deadline_s, again=again, heard=self.heard)

    def open(self, method: str, kind: str) -> Callable[..., Any]:
        return (self._nearest() or self._first).open(method, kind)

    def heard(self, head: Iterable[Any]) -> None:
        told = next((value for key, value in head if key == OWNER_KEY), "")
        if told:
            self._owner = told.partition(" ")[0]
            self._owners.find(self._owner)

    def lost(self) -> None:
        self._owner = ""

    def _nearest(self) -> Caller | None:
        return self._owners.find(self._owner) if self._owner else None
