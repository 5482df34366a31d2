# SPDX-License-Identifier: BSD-3-Clause
"""Long lists of numbers between numpy and the bytes of a message, without a Python object a number.

Protobuf's Python lists take and give their numbers one by one, which for 10,000 distances takes longer than the call.
In a message such a list is a tag, a length and the numbers in a row, which numpy reads and writes as they are.
"""
from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from google.protobuf.descriptor import Descriptor, FieldDescriptor
from google.protobuf.message import DecodeError
from numpy.typing import NDArray

_FIXED: dict[int, str] = {FieldDescriptor.TYPE_FLOAT: "<f4", FieldDescriptor.TYPE_DOUBLE: "<f8"}
_LENGTH_DELIMITED = 2


def varint(number: int) -> bytes:
    """A number of 0 or more as a varint."""
    out = bytearray()
    while number > 0x7F:
        out.append(number & 0x7F | 0x80)
        number >>= 7
    out.append(number)
    return bytes(out)


def bytes_field(message: Descriptor, name: str, data: bytes) -> bytes:
    """A field that holds bytes, a message or a packed list, ready to be put after other fields."""
    return varint(message.fields_by_name[name].number << 3 | _LENGTH_DELIMITED) + varint(len(data)) + data


def floats_field(message: Descriptor, name: str, values: NDArray[np.float32]) -> bytes:
    """A packed list of floats, of any shape, in C order; none where it is empty."""
    if values.size == 0:
        return b""
    return bytes_field(message, name, np.ascontiguousarray(values, dtype="<f4").tobytes())


def walk(data: memoryview) -> Iterator[tuple[int, int, int, memoryview]]:
    """The fields of a message: number, wire type, value (of a varint) and bytes (of all others)."""
    at = 0
    while at < len(data):
        key, at = _read_varint(data, at)
        number, kind, value = key >> 3, key & 7, 0
        start = at
        if kind == 0:
            value, at = _read_varint(data, at)
        elif kind == _LENGTH_DELIMITED:
            length, start = _read_varint(data, at)
            at = start + length
        elif kind in (1, 5):
            at += 8 if kind == 1 else 4
        else:
            raise DecodeError(f"field {number} is of the unknown wire type {kind}")
        if at > len(data):
            raise DecodeError(f"field {number} is cut off")
        yield number, kind, value, data[start:at]


def _read_varint(data: memoryview, at: int) -> tuple[int, int]:
    value = shift = 0
    while at < len(data) and shift < 70:
        byte = data[at]
        value |= (byte & 0x7F) << shift
        at, shift = at + 1, shift + 7
        if byte < 0x80:
            return value & 0xFFFF_FFFF_FFFF_FFFF, at
    raise DecodeError("a varint is cut off")


def read_columns(data: memoryview, message: Descriptor) -> dict[str, NDArray[np.generic]]:
    """Every list of numbers (and every `bytes`) of a message by its name, flat; those that are not there are empty."""
    parts: dict[int, list[memoryview]] = {}
    for number, kind, value, piece in walk(data):
        parts.setdefault(number, []).append(memoryview(varint(value)) if kind == 0 else piece)
    columns: dict[str, NDArray[np.generic]] = {}
    for field in message.fields:
        if field.type == FieldDescriptor.TYPE_MESSAGE or field.type == FieldDescriptor.TYPE_STRING:
            continue
        pieces = parts.get(field.number, [])
        joined = pieces[0] if len(pieces) == 1 else memoryview(b"".join(pieces))
        columns[field.name] = _decode(joined, field)
    return columns


def _decode(data: memoryview, field: FieldDescriptor) -> NDArray[np.generic]:
    if field.type in _FIXED:
        return np.frombuffer(data, dtype=_FIXED[field.type])
    if field.type == FieldDescriptor.TYPE_BYTES:
        return np.frombuffer(data, dtype=np.uint8)
    numbers = read_varints(data)
    return numbers.astype(bool) if field.type == FieldDescriptor.TYPE_BOOL else numbers


def read_varints(data: memoryview) -> NDArray[np.int64]:
    """Varints in a row, all at once."""
    octets = np.frombuffer(data, dtype=np.uint8)
    last = np.flatnonzero(octets < 0x80)
    if len(last) == len(octets):
        return octets.astype(np.int64)
    first = np.zeros_like(last)
    first[1:] = last[:-1] + 1
    length = last - first + 1
    if not len(last) or last[-1] != len(octets) - 1 or length.max() > 10:
        raise DecodeError("a list of varints is cut off")
    values = np.zeros(len(last), dtype=np.uint64)
    left = np.arange(len(last))  # those that have a k-th byte
    for k in range(int(length.max())):
        left = left[length[left] > k]
        values[left] |= (octets[first[left] + k] & np.uint8(0x7F)).astype(np.uint64) << np.uint64(7 * k)
    return values.view(np.int64)
