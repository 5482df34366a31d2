# SPDX-License-Identifier: BSD-3-Clause
"""An MCAP file, or a folder of them as ros2 bag writes it: its topics and its messages."""
from __future__ import annotations

import os
import pathlib
import re
import warnings
from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from typing import BinaryIO, NamedTuple

from dhpmap._errors import DataLoss, NotFound
from dhpmap.mcap._chunks import unpacked
from dhpmap.mcap._records import CutOff, Fields, Op, check_magic, records, records_of_chunk
from dhpmap.mcap._summary import Channel, Summary, add_channel, add_schema, read_summary


class McapWarning(UserWarning):
    """What is wrong with a recording that is read all the same, such as that it was cut off."""


class Message(NamedTuple):
    """A message as it was recorded; `data` is serialised as the topic's encoding says."""

    topic: str
    type: str
    log_time_ns: int
    data: bytes


@dataclass(frozen=True, slots=True)
class Topic:
    """What a recording says of a topic.

    Attributes:
        type: such as "sensor_msgs/msg/Image".
        encoding: of messages; "cdr" is that of ROS 2.
    """

    name: str
    type: str
    encoding: str
    num_messages: int


@dataclass(slots=True)
class _Known:
    """What is known of one file while it is read."""

    schemas: dict[int, str] = field(default_factory=dict)
    channels: dict[int, Channel] = field(default_factory=dict)


class Recording:
    """An MCAP file; or a folder of them, in the order of the numbers in their names.

    Nothing is kept but what is said of topics: a file of any size is read in the memory of its largest chunk. A file
    without an index, and one that was cut off, is read from its beginning as far as it is whole (McapWarning).
    Raises NotFound if there is no such file, DataLoss if it is no MCAP file.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = pathlib.Path(path)
        self._summaries: dict[pathlib.Path, Summary | None] = {}
        for file in _files(self.path):
            with open(file, "rb") as opened:
                check_magic(opened, file.name)
                self._summaries[file] = read_summary(opened)
        self._topics: tuple[Topic, ...] | None = None

    @property
    def topics(self) -> tuple[Topic, ...]:
        """By name. Of a file without an index they are counted, once, by reading it."""
        if self._topics is None:
            counts: Counter[tuple[str, str, str]] = Counter()
            for path, summary in self._summaries.items():
                counts.update(summary.counts if summary and summary.counts is not None else self._counted(path))
            self._topics = tuple(Topic(*key, count) for key, count in sorted(counts.items()))
        return self._topics

    def messages(self, topics: Collection[str] | None = None) -> Iterator[Message]:
        """Those of some topics, or all, in the order in which they were recorded."""
        for path in self._summaries:
            for channel, log_time_ns, data in self._messages(path, topics):
                yield Message(channel.topic, channel.type, log_time_ns, bytes(data))

    def _counted(self, path: pathlib.Path) -> Counter[tuple[str, str, str]]:
        return Counter((channel.topic, channel.type, channel.encoding) for channel, _, _ in self._messages(path, None))

    def _messages(self, path: pathlib.Path, topics: Collection[str] | None
                  ) -> Iterator[tuple[Channel, int, memoryview]]:
        summary = self._summaries[path]
        known = _Known(dict(summary.schemas), dict(summary.channels)) if summary else _Known()

        def passes_over(offset: int) -> bool:
            inside = summary.channels_of_chunk.get(offset) if summary else None
            return inside is not None and topics is not None and not any(
                known.channels[its].topic in topics for its in inside if its in known.channels)

        with open(path, "rb") as file:
            check_magic(file, path.name)
            try:
                for kind, body in _flat(file, path.name, passes_over):
                    if (read := _read(kind, body, known, topics, path.name)) is not None:
                        yield read
            except CutOff as error:
                warnings.warn(f"{error.args[0]}; what is whole before that is read", McapWarning, stacklevel=3)


def _flat(file: BinaryIO, name: str, passes_over: object) -> Iterator[tuple[Op, memoryview]]:
    """The records of a file's data section, those within chunks as if there were none."""
    assert callable(passes_over)
    for kind, _, body in records(file, os.fstat(file.fileno()).st_size, name, passes_over=passes_over):
        if kind == Op.CHUNK:
            yield from records_of_chunk(unpacked(body, name), name)
        elif kind in (Op.DATA_END, Op.FOOTER):
            return
        else:
            yield kind, memoryview(body)


def _read(kind: Op, body: memoryview, known: _Known, topics: Collection[str] | None, name: str
          ) -> tuple[Channel, int, memoryview] | None:
    if kind == Op.SCHEMA:
        add_schema(body, known.schemas)
    elif kind == Op.CHANNEL:
        add_channel(body, known.schemas, known.channels)
    elif kind == Op.MESSAGE:
        fields = Fields(body, "message")
        channel_id, _, log_time_ns, _ = fields.numbers("HIQQ")
        if channel_id not in known.channels:
            raise DataLoss(f"{name} has a message of channel {channel_id}, which is not declared before it")
        if topics is None or known.channels[channel_id].topic in topics:
            return known.channels[channel_id], log_time_ns, fields.rest()
    return None


def _files(path: pathlib.Path) -> list[pathlib.Path]:
    if path.is_file():
        return [path]
    if not path.is_dir():
        raise NotFound(f"there is no recording {path}")
    found = sorted(path.glob("*.mcap"), key=lambda file: [int(part) if part.isdigit() else part
                                                          for part in re.split(r"(\d+)", file.name)])
    if not found:
        raise NotFound(f"the folder {path} has no file *.mcap")
    return found
