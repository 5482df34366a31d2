# SPDX-License-Identifier: BSD-3-Clause
"""Packed answers as columns: numpy arrays in the shape of what was asked."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from google.protobuf.message import DecodeError, Message
from numpy.typing import NDArray

from dhpmap._source import Source
from dhpmap._wire import read_columns, walk
from dhpmap.v1 import query_options_pb2

MOST_ROWS_A_CALL = 1_000_000

OK = query_options_pb2.QueryStatus.OK
CLAMPED = query_options_pb2.QueryStatus.CLAMPED
UNKNOWN = query_options_pb2.QueryStatus.UNKNOWN


def is_status(column: NDArray[np.uint8], status: int) -> NDArray[np.bool_]:
    is_so: NDArray[np.bool_] = column == status
    return is_so


@dataclass(frozen=True, slots=True)
class Packed:
    """The columns of an answer by their names in the message, one after the other."""

    revision: int
    columns: dict[str, NDArray[np.generic]]

    def floats(self, name: str, shape: tuple[int, ...]) -> NDArray[np.float32]:
        return self._shaped(name, shape).astype(np.float32, copy=False)

    def ints(self, name: str, shape: tuple[int, ...]) -> NDArray[np.int64]:
        return self._shaped(name, shape).astype(np.int64, copy=False)

    def octets(self, name: str, shape: tuple[int, ...]) -> NDArray[np.uint8]:
        return self._shaped(name, shape).astype(np.uint8, copy=False)

    def bools(self, name: str, shape: tuple[int, ...]) -> NDArray[np.bool_]:
        return self._shaped(name, shape).astype(np.bool_, copy=False)

    def _shaped(self, name: str, shape: tuple[int, ...]) -> NDArray[np.generic]:
        column = self.columns[name]
        if column.size != int(np.prod(shape)):
            raise DecodeError(f"{name} has {column.size} values, not {int(np.prod(shape))}")
        return column.reshape(shape)


def ask_packed(source: Source, query: type[Message], answer: type[Message], num_rows: int,
               request: Callable[[slice, int], bytes], *, deadline_s: float | None = None) -> Packed:
    """Asks for all rows, in several calls where one would be too large: all from the first one's revision.

    `request` makes the bytes of a request for some rows at a revision (0: the present one).
    """
    parts: list[Packed] = []
    revision = source.read_revision
    for first in range(0, max(num_rows, 1), MOST_ROWS_A_CALL):
        data = source.answer(query, request(slice(first, first + MOST_ROWS_A_CALL), revision), deadline_s=deadline_s)
        parts.append(_read(data, answer))
        revision = parts[0].revision
    if len(parts) == 1:
        return parts[0]
    joined = {name: np.concatenate([part.columns[name] for part in parts]) for name in parts[0].columns}
    return Packed(parts[0].revision, joined)


def _read(data: bytes, answer: type[Message]) -> Packed:
    revision, packed = 0, memoryview(b"")
    fields = answer.DESCRIPTOR.fields_by_name
    for number, _, value, piece in walk(memoryview(data)):
        if number == fields["revision"].number:
            revision = value
        elif number == fields["packed"].number:
            packed = piece
    return Packed(revision, read_columns(packed, fields["packed"].message_type))
