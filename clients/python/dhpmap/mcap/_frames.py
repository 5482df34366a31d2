# SPDX-License-Identifier: BSD-3-Clause
"""Frames of a recording, one after the other."""
from __future__ import annotations

import os
import warnings
from collections import deque
from collections.abc import Iterator, Mapping
from typing import Any, Unpack

import numpy as np
from numpy.typing import NDArray

from dhpmap._errors import InvalidArgument
from dhpmap.mcap._build import Builder
from dhpmap.mcap._frame import LidarFrame, RgbdFrame
from dhpmap.mcap._join import MOST_WAITING_BYTES, WAIT_S, Held, Joiner
from dhpmap.mcap._messages import (COMPRESSED_IMAGE, DETECTIONS, LABEL_INFO, read_camera_info, read_compressed_image,
                                   read_detections, read_image, read_label_info, read_point_cloud, read_transforms)
from dhpmap.mcap._options import FrameOptions
from dhpmap.mcap._recording import McapWarning, Message, Recording
from dhpmap.mcap._topics import choose, type_of
from dhpmap.mcap._transforms import Gap, Transforms


class Frames:
    """The frames of a recording, by time; iterate over it once.

    What waits for what belongs to it is at most WAIT_S of the recording, so a recording of any size is read.
    Frames before the first transform and after the last are left out. Iterating raises InvalidArgument for what a frame
    cannot be made of, OutOfRange (reason NO_TRANSFORM) for a gap in the transforms, DataLoss for damage.

    Attributes:
        num_expected: frames if to each message belongs what it needs.
        num_unmatched: left out so far, for an image was missing within the tolerance.
        num_without_pose: left out so far, for no transform was known.
    """

    def __init__(self, path: str | os.PathLike[str], **options: Unpack[FrameOptions]) -> None:
        if unknown := options.keys() - FrameOptions.__annotations__.keys():
            raise InvalidArgument(f"there is no option {min(unknown)!r}; there are "
                                  f"{', '.join(FrameOptions.__annotations__)}")
        self._recording = Recording(path)
        topics = self._recording.topics
        self._chosen = choose(topics, options)
        self._types = {its.name: type_of(its) for its in topics}
        self._options = options
        self._transforms = Transforms(options.get("max_gap_s", 0.5))
        self._builder = Builder(self._chosen, options)
        others = [its for its in (self._chosen.color, self._chosen.labels) if its]
        if self._types.get(self._chosen.label_table) == DETECTIONS:
            others.append(self._chosen.label_table)
        self._joiner = Joiner(others, options.get("tolerance_s", 0.02))
        self._waiting: deque[tuple[Held, Mapping[str, Any]]] = deque()
        self._waiting_bytes = 0  # of leading messages
        self._has_made = False
        self._last_gap: Gap | None = None
        self.num_expected = next(its.num_messages for its in topics if its.name == self._chosen.lead)
        self.num_without_pose = 0
        self._read_ahead()

    @property
    def num_unmatched(self) -> int:
        return self._joiner.num_unmatched

    def __iter__(self) -> Iterator[RgbdFrame | LidarFrame]:
        chosen, now_ns = self._chosen, 0
        wanted = {chosen.lead, chosen.color, chosen.camera_info, chosen.labels, chosen.label_table, *chosen.transforms}
        for message in self._recording.messages(wanted):
            now_ns = max(now_ns, message.log_time_ns)
            self._take(message)
            yield from self._made(now_ns)
        yield from self._made(now_ns, is_end=True)
        if self._last_gap is not None and not self._has_made:
            raise self._last_gap
        if self.num_unmatched or self.num_without_pose:
            warnings.warn(f"of {self.num_expected} frames, {self.num_unmatched} were left out for want of an image of "
                          f"that stamp, {self.num_without_pose} for want of a transform", McapWarning, stacklevel=2)

    def _read_ahead(self) -> None:
        """What is said once, such as the camera, may stand behind the first images."""
        chosen = self._chosen
        if chosen.camera_info:
            first = next(self._recording.messages({chosen.camera_info}), None)
            if first is not None:
                self._builder.set_camera(read_camera_info(first.data))
        if "classes" in self._options:
            self._builder.set_names(self._options["classes"])
        elif self._types.get(chosen.label_table) == LABEL_INFO:
            first = next(self._recording.messages({chosen.label_table}), None)
            if first is not None:
                self._builder.set_names(read_label_info(first.data))

    def _take(self, message: Message) -> None:
        chosen, topic, data = self._chosen, message.topic, message.data
        if topic in chosen.transforms:
            self._transforms.add(read_transforms(data), is_static=topic.endswith("_static"))
        elif topic == chosen.camera_info:
            self._builder.set_camera(read_camera_info(data))
        elif topic == chosen.label_table and self._types[topic] == LABEL_INFO:
            if "classes" not in self._options:
                self._builder.set_names(read_label_info(data))
        else:
            read = _readers(self._types[topic], topic == chosen.lead and chosen.is_cloud)(data)
            held = Held(read.stamp_ns, message.log_time_ns, len(data), read)
            if topic == chosen.lead:
                self._joiner.add_lead(held)
            else:
                self._joiner.add(topic, held)

    def _made(self, now_ns: int, *, is_end: bool = False) -> Iterator[RgbdFrame | LidarFrame]:
        for joined in self._joiner.joined(now_ns, is_end=is_end):
            self._waiting.append(joined)
            self._waiting_bytes += joined[0].num_bytes
        while self._waiting:
            lead, others = self._waiting[0]
            image = others.get(self._chosen.labels) or others.get(self._chosen.color) if self._chosen.is_cloud else None
            try:
                pose = self._pose_of(lead.message)
                image_pose = self._pose_of(image) if image is not None else None
            except Gap as gap:
                waited = now_ns - lead.log_time_ns > WAIT_S * 1e9 or self._waiting_bytes > MOST_WAITING_BYTES
                if gap.may_come and not (is_end or waited):
                    return
                self._leave_out(gap, is_end)
                continue
            self._drop()
            self._has_made = True
            if self._chosen.is_cloud:
                yield self._builder.lidar(lead.message, others, pose, image_pose)
            else:
                yield self._builder.rgbd(lead.message, others, pose)

    def _pose_of(self, message: Any) -> NDArray[np.float64]:
        """Of its frame in the map, at its stamp. Raises Gap."""
        return self._transforms.lookup(self._options.get("map_frame", "map"), message.frame_id, message.stamp_ns)

    def _leave_out(self, gap: Gap, is_end: bool) -> None:
        told = Gap(f"{gap.args[0]}; frames that /tf names: {', '.join(self._transforms.frames) or 'none'} "
                   "(map_frame= says which one is the map's, skip_gaps=True leaves such frames out)", may_come=False)
        if self._has_made and not is_end and not self._options.get("skip_gaps", False):
            raise told
        self._last_gap = told
        self._drop()
        self.num_without_pose += 1

    def _drop(self) -> None:
        self._waiting_bytes -= self._waiting.popleft()[0].num_bytes


def _readers(kind: str, is_cloud: bool) -> Any:
    if is_cloud:
        return read_point_cloud
    return {COMPRESSED_IMAGE: read_compressed_image, DETECTIONS: read_detections}.get(kind, read_image)
