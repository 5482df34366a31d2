# SPDX-License-Identifier: BSD-3-Clause
"""What an MCAP file says at its end of what is in it: topics, counts, and which chunk holds which of them."""
from __future__ import annotations

import os
import zlib
from collections import Counter
from dataclasses import dataclass, field
from typing import BinaryIO, NamedTuple

from dhpmap._errors import DataLoss
from dhpmap.mcap._records import MAGIC, Fields, Op, records

FOOTER_BYTES = 9 + 20
MOST_SUMMARY_BYTES = 256 << 20


class Channel(NamedTuple):
    topic: str
    type: str
    encoding: str


@dataclass(slots=True)
class Summary:
    """
    Attributes:
        counts: messages by topic, type and encoding; None: the file does not say.
        channels_of_chunk: by the chunk's offset, those with messages in it.
    """

    schemas: dict[int, str] = field(default_factory=dict)
    channels: dict[int, Channel] = field(default_factory=dict)
    counts: Counter[tuple[str, str, str]] | None = None
    channels_of_chunk: dict[int, frozenset[int]] = field(default_factory=dict)


def read_summary(file: BinaryIO) -> Summary | None:
    """None: there is none, or it is damaged; the file is then read from its beginning."""
    size = os.fstat(file.fileno()).st_size
    tail_bytes = FOOTER_BYTES + len(MAGIC)
    if size < len(MAGIC) + tail_bytes:
        return None
    file.seek(size - tail_bytes)
    tail = file.read(tail_bytes)
    if not tail.endswith(MAGIC) or tail[0] != Op.FOOTER:
        return None
    start, _, crc = Fields(tail[9:FOOTER_BYTES], "footer").numbers("QQI")
    if not len(MAGIC) <= start < size - tail_bytes or size - start > MOST_SUMMARY_BYTES:
        return None
    file.seek(start)
    if crc not in (0, zlib.crc32(file.read(size - start - len(MAGIC) - 4))):
        return None
    file.seek(start)
    try:
        return _read_records(file, size)
    except DataLoss:
        return None


def _read_records(file: BinaryIO, size: int) -> Summary:
    summary, count_of_channel = Summary(), None
    for kind, _, body in records(file, size, "the summary"):
        if kind == Op.SCHEMA:
            add_schema(body, summary.schemas)
        elif kind == Op.CHANNEL:
            add_channel(body, summary.schemas, summary.channels)
        elif kind == Op.CHUNK_INDEX:
            fields = Fields(body, "chunk index")
            _, _, offset, _ = fields.numbers("QQQQ")
            if inside := fields.pairs("HQ"):  # none: written without indexes of messages
                summary.channels_of_chunk[offset] = frozenset(inside)
        elif kind == Op.STATISTICS:
            fields = Fields(body, "statistics")
            fields.numbers("QHIIIIQQ")
            count_of_channel = fields.pairs("HQ")
    if count_of_channel is not None and count_of_channel.keys() <= summary.channels.keys():
        summary.counts = Counter({channel: 0 for channel in summary.channels.values()})
        for number, count in count_of_channel.items():
            summary.counts[summary.channels[number]] += count
    return summary


def add_schema(body: bytes | memoryview, schemas: dict[int, str]) -> None:
    fields = Fields(body, "schema")
    (number,) = fields.numbers("H")
    schemas[number] = fields.text()


def add_channel(body: bytes | memoryview, schemas: dict[int, str], channels: dict[int, Channel]) -> None:
    fields = Fields(body, "channel")
    number, schema = fields.numbers("HH")
    topic, encoding = fields.text(), fields.text()
    channels[number] = Channel(topic, schemas.get(schema, ""), encoding)
