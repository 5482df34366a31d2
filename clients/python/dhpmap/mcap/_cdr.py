# SPDX-License-Identifier: BSD-3-Clause
"""CDR, in which ROS 2 serialises messages: aligned numbers of either byte order."""
from __future__ import annotations

import struct

import numpy as np
from numpy.typing import NDArray

from dhpmap._errors import DataLoss, Unimplemented

_HEADER_BYTES = 4


class Cdr:
    """The fields of a message, one after the other. Raises DataLoss where it ends before they do."""

    def __init__(self, data: bytes, what: str) -> None:
        self._data, self._what, self._at = memoryview(data), what, _HEADER_BYTES
        if len(data) < _HEADER_BYTES:
            raise DataLoss(f"a message of {what} has only {len(data)} bytes")
        if data[0] != 0 or data[1] > 1:
            raise Unimplemented(f"a message of {what} is not in plain CDR: representation {data[0]:02x} {data[1]:02x}")
        self._order = "<" if data[1] else ">"

    def _take(self, count: int, alignment: int = 1) -> memoryview:
        first = self._at + -(self._at - _HEADER_BYTES) % alignment
        end = first + count
        if end > len(self._data):
            raise DataLoss(f"a message of {self._what} ends too early: at byte {len(self._data)} of at least {end}; "
                           "is it of another version of that type?")
        self._at = end
        return self._data[first:end]

    def _number(self, letter: str) -> int | float:
        size = struct.calcsize(letter)
        number: int | float = struct.unpack(self._order + letter, self._take(size, size))[0]
        return number

    def u8(self) -> int:
        return self._take(1)[0]

    def u16(self) -> int:
        return int(self._number("H"))

    def u32(self) -> int:
        return int(self._number("I"))

    def f32(self) -> float:
        return self._number("f")

    def f64(self) -> float:
        return self._number("d")

    def f64s(self, count: int) -> NDArray[np.float64]:
        if count == 0:
            return np.zeros(0)
        return np.frombuffer(self._take(8 * count, 8), self._order + "f8").astype(np.float64)

    def text(self) -> str:
        """Its length counts the 0 at its end."""
        return bytes(self._take(self.u32())).rstrip(b"\0").decode(errors="replace")

    def octets(self) -> memoryview:
        return self._take(self.u32())

    def count(self, least_bytes: int) -> int:
        """Of a sequence whose elements have at least so many bytes: none that the rest of the message cannot hold."""
        count = self.u32()
        if count * least_bytes > len(self._data) - self._at:
            raise DataLoss(f"a message of {self._what} says that {count} elements follow, which it has no room for")
        return count

    def stamp_ns(self) -> int:
        """Of seconds (signed) and nanoseconds."""
        seconds = int(self._number("i"))
        return seconds * 1_000_000_000 + self.u32()

    def end(self) -> None:
        """Raises if fields are left, but for padding: the type then has others than were read."""
        if (left := len(self._data) - self._at) >= 8:
            raise Unimplemented(f"a message of {self._what} has {left} bytes more than are known of that type: "
                                "it is of another version")
