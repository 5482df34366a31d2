# SPDX-License-Identifier: BSD-3-Clause
"""Records of an MCAP file (version 0): an opcode, a length, a body of fields."""
from __future__ import annotations

import os
import struct
from collections.abc import Callable, Iterator
from enum import IntEnum
from typing import BinaryIO

from dhpmap._errors import DataLoss

MAGIC = b"\x89MCAP0\r\n"
MOST_RECORD_BYTES = 1 << 30


class Op(IntEnum):
    """Kinds of records that are looked at; all others are passed over."""

    FOOTER = 0x02
    SCHEMA = 0x03
    CHANNEL = 0x04
    MESSAGE = 0x05
    CHUNK = 0x06
    CHUNK_INDEX = 0x08
    STATISTICS = 0x0B
    DATA_END = 0x0F


_KNOWN = frozenset(Op)


class CutOff(DataLoss):
    """The file ends within a record."""


class Fields:
    """The fields of a record, one after the other. Raises DataLoss where they reach beyond its end."""

    def __init__(self, body: bytes | memoryview, what: str) -> None:
        self._body, self._what, self.at = memoryview(body), what, 0

    def octets(self, count: int) -> memoryview:
        end = self.at + count
        if end > len(self._body):
            raise DataLoss(f"a {self._what} record is damaged: a field of {count} bytes where "
                           f"{len(self._body) - self.at} are left")
        part, self.at = self._body[self.at:end], end
        return part

    def numbers(self, layout: str) -> tuple[int, ...]:
        """Integers, little-endian and packed: H of 16, I of 32, Q of 64 bits."""
        read: tuple[int, ...] = struct.unpack("<" + layout, self.octets(struct.calcsize("<" + layout)))
        return read

    def text(self) -> str:
        return bytes(self.octets(*self.numbers("I"))).decode(errors="replace")

    def pairs(self, layout: str) -> dict[int, int]:
        """A map of integers by integers."""
        inner = self.octets(*self.numbers("I"))
        if len(inner) % struct.calcsize("<" + layout):
            raise DataLoss(f"a {self._what} record is damaged: a map of {len(inner)} bytes")
        return {key: value for key, value in struct.iter_unpack("<" + layout, inner)}

    def rest(self) -> memoryview:
        return self.octets(len(self._body) - self.at)


def check_magic(file: BinaryIO, name: str) -> None:
    """Raises DataLoss if it is no such file; leaves it after the magic bytes."""
    file.seek(0)
    magic = file.read(len(MAGIC))
    if magic == MAGIC:
        return
    hint = "is compressed as a whole: unpack it with zstd -d" if magic[:4] == b"\x28\xb5\x2f\xfd" else \
        "is a bag of ROS 1" if magic.startswith(b"#ROSBAG") else \
        "is a bag of SQLite: convert it with ros2 bag convert" if magic.startswith(b"SQLite") else \
        "is empty" if not magic else "does not begin as an MCAP file of version 0"
    raise DataLoss(f"{name} {hint}")


def records(file: BinaryIO, end: int, name: str, *, passes_over: Callable[[int], bool] = lambda offset: False
            ) -> Iterator[tuple[Op, int, bytes]]:
    """Kind, offset and body of each record from where the file is, up to the footer.

    passes_over: asked with a chunk's offset. Raises CutOff where the file ends before its footer, after all that is
    whole.
    """
    at = file.tell()
    while True:
        head = file.read(9)
        kind, length = struct.unpack("<BQ", head) if len(head) == 9 else (0, 0)
        if len(head) < 9 or length > end - at - 9:
            raise CutOff(f"{name} ends within a record at byte {at} of {end}: its recording was cut off")
        if kind not in _KNOWN or (kind == Op.CHUNK and passes_over(at)):
            file.seek(length, os.SEEK_CUR)
        elif length > MOST_RECORD_BYTES:
            raise DataLoss(f"{name} has a record of {length} bytes at byte {at}; at most {MOST_RECORD_BYTES} are read")
        else:
            yield Op(kind), at, file.read(length)
        if kind == Op.FOOTER:
            return
        at += 9 + length


def records_of_chunk(body: memoryview, name: str) -> Iterator[tuple[Op, memoryview]]:
    """Kind and body of each record of an unpacked chunk."""
    at = 0
    while at < len(body):
        kind, length = struct.unpack_from("<BQ", body, at) if len(body) - at >= 9 else (0, len(body))
        if length > len(body) - at - 9:
            raise DataLoss(f"{name} has a chunk whose records reach beyond its end")
        if kind in _KNOWN:
            yield Op(kind), body[at + 9:at + 9 + length]
        at += 9 + length
