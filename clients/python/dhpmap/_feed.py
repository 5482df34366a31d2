# SPDX-License-Identifier: BSD-3-Clause
"""Frames go into a map."""
from __future__ import annotations

import warnings
from collections import Counter
from collections.abc import Mapping
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dhpmap._call import Caller
from dhpmap._camera import Camera
from dhpmap._errors import bad_argument, error_of_status
from dhpmap._frame_stream import FrameStream
from dhpmap._frames import LidarImage, Segments, checked_stamp, lidar_frame, rgbd_frame, unlisted_ids
from dhpmap._map_info import session_messages
from dhpmap.v1 import mapping_service_pb2 as pb2

CLOSE_S = 120.0


class FrameWarning(UserWarning):
    """What speaks against a frame, which is fused all the same; or why one was refused. The first of a kind is told."""


class Feed:
    """A session of frames of one robot. A call returns once there is room, before its frame is fused.

    Frames are kept until the server has stored them: a lost connection, or a server that starts anew, is waited for,
    and what it lacks is sent again. Leaving the `with` block waits until all is stored. One thread feeds.
    """

    def __init__(self, caller: Caller, map_name: str, session: str, *, camera: Camera | ArrayLike | None,
                 class_ids: Mapping[str, int], depth_scale_m: float | None, persistent_ids: bool, take_over: bool,
                 refuse_implausible: bool, reconnect_s: float, memory_mib: int, deadline_s: float,
                 progress: bool | int) -> None:
        self._camera = camera
        self._class_ids, self._depth_scale_m, self._persistent_ids = class_ids, depth_scale_m, persistent_ids
        self._deadline_s = deadline_s
        self._last_stamp_ns: int | None = None
        self._told: Counter[str] = Counter()
        self._stream = FrameStream(caller, map_name, session, take_over=take_over,
                                   refuse_implausible=refuse_implausible, reconnect_s=reconnect_s,
                                   memory_bytes=memory_mib << 20)
        try:
            self._stream.wait_until_greeted(deadline_s)
            self._next = 1 + max(self._stream.stored_sequence or 0, _taken(caller, map_name, session))
        except BaseException:
            self._stream.abandon()
            raise
        self._bar = _bar(progress, session)
        self.num_sent = 0
        self.num_refused = 0

    def rgbd(self, depth_m: ArrayLike, rgb: ArrayLike | None = None, labels: ArrayLike | None = None,
             segments: Segments | None = None, T_map_camera: ArrayLike | None = None, stamp_ns: int | None = None
             ) -> int:
        """Feeds images of one size that belong together pixel by pixel; returns the frame's sequence.

        depth_m: (H, W), float metres along the optical axis, 0 or NaN: no return; or uint16 with feed(depth_scale_m=).
        rgb: (H, W, 3) uint8. labels: (H, W) integer ids of segments, 0: none. segments: what they are, such as
        {1: "chair", 2: "wall"}, or a list of Segment; ids without a row count as unknown. With feed(camera=Camera(...))
        depth_m and rgb may be the bytes of a PNG, JPEG or TIFF file (depth of 16 bits).
        T_map_camera: (4, 4) from the optical frame (x right, y down, z forward) to the map's (z up).
        stamp_ns: nanoseconds of the sensor's clock, ascending.

        Raises InvalidArgument for what is wrong with it, before it is sent; what has ended the feed, such as Aborted
        (reason FEED_TAKEN_OVER); DeadlineExceeded if the server says nothing for deadline_s.
        """
        if T_map_camera is None or stamp_ns is None:
            raise bad_argument("T_map_camera" if T_map_camera is None else "stamp_ns", "is missing")
        if segments is not None and not isinstance(segments, Mapping):
            segments = list(segments)
        camera = self._camera_of(np.shape(depth_m))
        stamp = checked_stamp(stamp_ns, self._last_stamp_ns)
        frame = rgbd_frame(camera, depth_m, rgb, labels, segments, T_map_camera, stamp, scale_m=self._depth_scale_m,
                           class_ids=self._class_ids, persistent_ids=self._persistent_ids)
        sequence = self._push(frame, stamp)
        if labels is not None and segments is not None and not self._told["UNLISTED_IDS"]:
            self._doubt_ids(labels, segments, sequence)
        return sequence

    def lidar(self, points_m: ArrayLike, T_map_lidar: ArrayLike, stamp_ns: int, *, segment_ids: ArrayLike | None = None,
              segments: Segments | None = None, rgb: ArrayLike | None = None, image: LidarImage | None = None) -> int:
        """Feeds a scan: points_m (N, 3) in the LiDAR's frame, segment_ids (N,), rgb (N, 3) uint8. Else as `rgbd`.

        image: of a camera beside it, from which points take colour and ids instead.
        """
        stamp = checked_stamp(stamp_ns, self._last_stamp_ns)
        frame = lidar_frame(points_m, segment_ids, segments, rgb, image, T_map_lidar, stamp, class_ids=self._class_ids,
                            persistent_ids=self._persistent_ids)
        return self._push(frame, stamp)

    @property
    def num_fused(self) -> int:
        """Frames that the server has acknowledged as fused."""
        return self._stream.num_fused

    @property
    def stored_sequence(self) -> int | None:
        """The newest frame that is stored, with all before it."""
        return self._stream.stored_sequence

    def close(self) -> None:
        """Waits until all is stored. Raises what has ended the feed before."""
        try:
            self._stream.close(CLOSE_S)
        finally:
            self._hear(stacklevel=3)
            self._bar.close()

    def _push(self, frame: bytes, stamp_ns: int) -> int:
        sequence = self._next
        self._stream.push(sequence, frame, self._deadline_s)
        self._next, self._last_stamp_ns = sequence + 1, stamp_ns
        self.num_sent += 1
        self._bar.update(1)
        self._hear(stacklevel=4)
        return sequence

    def _doubt_ids(self, labels: ArrayLike, segments: Segments, sequence: int) -> None:
        ids = unlisted_ids(labels, segments)
        if ids:
            some = ", ".join(map(str, ids[:5])) + (", ..." if len(ids) > 5 else "")
            self._warn("UNLISTED_IDS", f"frame {sequence}: labels has ids that segments lacks, {some}: they are taken "
                       "as unknown", stacklevel=3)

    def _camera_of(self, shape: tuple[int, ...]) -> Camera:
        if self._camera is None:
            raise bad_argument("camera", "feed(..., camera=...) is missing: a dhpmap.Camera or a 3 x 3 matrix")
        if not isinstance(self._camera, Camera):
            if len(shape) != 2:
                raise bad_argument("depth_m", f"wanted (height, width), got {shape}")
            self._camera = Camera.from_matrix(self._camera, shape[1], shape[0])
        return self._camera

    def _hear(self, stacklevel: int) -> None:
        """Warns of the first frame of a kind; the others are counted."""
        while self._stream.told:
            answer = self._stream.told.popleft()
            if answer.outcome == pb2.IntegrateFramesResponse.REFUSED:
                self.num_refused += 1
                error = error_of_status(answer.error, f"frame {answer.sequence} was refused: ")
                self._warn(error.reason, str(error.args[0]), stacklevel)
            for warning in answer.warnings:
                self._warn(pb2.FrameWarning.Fault.Name(warning.fault), f"frame {answer.sequence}: {warning.message}",
                           stacklevel)

    def _warn(self, kind: str, message: str, stacklevel: int) -> None:
        self._told[kind] += 1
        if self._told[kind] == 1:
            warnings.warn(f"{message} [{kind}]", FrameWarning, stacklevel=stacklevel + 1)

    def __enter__(self) -> Feed:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()


def _taken(caller: Caller, map_name: str, session: str) -> int:
    """The last sequence that the session has taken; 0: none."""
    return max((its.accepted_sequence for its in session_messages(caller, map_name) if its.session == session),
               default=0)


class _NoBar:
    def update(self, count: int) -> None:
        """Nothing is shown."""

    def close(self) -> None:
        """Nothing is shown."""


def _bar(progress: bool | int, session: str) -> Any:
    """A bar of tqdm, where it is installed; a number says how many frames there will be."""
    if progress is False:
        return _NoBar()
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _NoBar()
    return tqdm(total=None if progress is True else progress, desc=session, unit=" frames")
