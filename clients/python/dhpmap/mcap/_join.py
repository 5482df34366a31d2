# SPDX-License-Identifier: BSD-3-Clause
"""Messages of several topics put together by their stamps."""
from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

WAIT_S = 2.0  # of recording, for what belongs to a message
MOST_WAITING_BYTES = 512 << 20


class Held(NamedTuple):
    """A message that waits. log_time_ns: when it was recorded."""

    stamp_ns: int
    log_time_ns: int
    num_bytes: int
    message: Any


class Joiner:
    """Puts to each message of a leading topic the nearest of every other one, within a tolerance.

    The stamps of each other topic go up. What waits is bounded in time of recording and in bytes: beyond that a message
    is decided with what is there.
    """

    def __init__(self, others: Iterable[str], tolerance_s: float) -> None:
        self._tolerance_ns = round(tolerance_s * 1e9)
        self._leads: deque[Held] = deque()
        self._others: dict[str, deque[Held]] = {topic: deque() for topic in others}
        self._num_bytes = 0
        self.num_unmatched = 0  # leading messages to which one was missing

    def add_lead(self, held: Held) -> None:
        self._leads.append(held)
        self._num_bytes += held.num_bytes

    def add(self, topic: str, held: Held) -> None:
        self._others[topic].append(held)
        self._num_bytes += held.num_bytes
        while self._num_bytes > MOST_WAITING_BYTES and not self._leads and len(self._others[topic]) > 1:
            self._drop(self._others[topic])

    def joined(self, now_ns: int, *, is_end: bool = False) -> Iterator[tuple[Held, dict[str, Any]]]:
        """Those that are decided at a time of recording, with what belongs to them by topic."""
        while self._leads:
            lead = self._leads[0]
            waited = is_end or now_ns - lead.log_time_ns > WAIT_S * 1e9 or self._num_bytes > MOST_WAITING_BYTES
            if not waited and any(self._may_come(lead, others) for others in self._others.values()):
                return
            found = {topic: self._nearest(lead, others) for topic, others in self._others.items()}
            self._drop(self._leads)
            for others in self._others.values():
                while others and others[0].stamp_ns < lead.stamp_ns - self._tolerance_ns:
                    self._drop(others)
            if any(its is None for its in found.values()):
                self.num_unmatched += 1
                continue
            yield lead, {topic: its.message for topic, its in found.items() if its is not None}

    @staticmethod
    def _may_come(lead: Held, others: deque[Held]) -> bool:
        """One that is nearer than those that are there; stamps go up, so none does after one at the lead's or later."""
        return not others or others[-1].stamp_ns < lead.stamp_ns

    def _nearest(self, lead: Held, others: deque[Held]) -> Held | None:
        best = min(others, key=lambda its: abs(its.stamp_ns - lead.stamp_ns), default=None)
        return best if best is not None and abs(best.stamp_ns - lead.stamp_ns) <= self._tolerance_ns else None

    def _drop(self, held: deque[Held]) -> None:
        self._num_bytes -= held.popleft().num_bytes
