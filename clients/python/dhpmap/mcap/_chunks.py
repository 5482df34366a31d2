# SPDX-License-Identifier: BSD-3-Clause
"""Chunks of an MCAP file: many records, packed together."""
from __future__ import annotations

import importlib
import zlib
from types import ModuleType

from dhpmap._errors import DataLoss, Unimplemented
from dhpmap.mcap._records import MOST_RECORD_BYTES, Fields


def unpacked(body: bytes, name: str) -> memoryview:
    """The records of a chunk record. DataLoss if it is damaged; Unimplemented if what unpacks it is not installed."""
    fields = Fields(body, "chunk")
    _, _, size, crc = fields.numbers("QQQI")
    compression = fields.text()
    packed = fields.octets(*fields.numbers("Q"))
    if size > MOST_RECORD_BYTES:
        raise DataLoss(f"{name} has a chunk of {size} bytes; at most {MOST_RECORD_BYTES} are unpacked")
    data = memoryview(_unpack(compression, packed, size, name))
    if len(data) != size:
        raise DataLoss(f"{name} has a damaged chunk: it unpacks to other than {size} bytes")
    if crc not in (0, zlib.crc32(data)):
        raise DataLoss(f"{name} has a damaged chunk: its checksum does not hold")
    return data


def _unpack(compression: str, packed: memoryview, size: int, name: str) -> bytes | memoryview:
    """At most one byte more than size, whatever the data say of themselves."""
    if compression == "":
        return packed
    if compression not in ("lz4", "zstd"):
        raise Unimplemented(f"{name} has chunks packed as {compression!r}; none, lz4 and zstd can be read")
    try:
        if compression == "lz4":
            lz4 = _module("lz4.frame", "python3-lz4", "lz4", name)
            unpacked_lz4: bytes = lz4.LZ4FrameDecompressor().decompress(packed, max_length=size + 1)
            return unpacked_lz4
        zstd = _module("zstandard", "python3-zstandard", "zstandard", name)
        with zstd.ZstdDecompressor().stream_reader(packed) as reader:
            unpacked_zstd: bytes = reader.read(size + 1)
            return unpacked_zstd
    except (RuntimeError, ValueError, EOFError) as error:
        raise DataLoss(f"{name} has a damaged chunk: {error}") from None
    except Exception as error:  # zstandard.ZstdError is no RuntimeError
        if type(error).__name__ == "ZstdError":
            raise DataLoss(f"{name} has a damaged chunk: {error}") from None
        raise


def _module(module: str, debian: str, pip: str, name: str) -> ModuleType:
    try:
        return importlib.import_module(module)
    except ImportError:
        raise Unimplemented(f"{name} is packed by {pip}: install {debian} (or pip install {pip})") from None
