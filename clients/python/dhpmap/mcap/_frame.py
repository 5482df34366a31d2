# SPDX-License-Identifier: BSD-3-Clause
"""One frame of a recording, as a Feed takes it."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dhpmap._camera import Camera
from dhpmap._feed import Feed
from dhpmap._frames import LidarImage, Segment


@dataclass(frozen=True, eq=False, slots=True)
class RgbdFrame:
    """Images of a depth camera, with what Feed.rgbd takes.

    Attributes:
        T_map_camera: (4, 4), of the optical frame at stamp_ns.
        depth: (H, W), float32 metres, or uint16 units of depth_scale_m; or a PNG file of these, as it was recorded.
        rgb: (H, W, 3) uint8, or a JPEG or PNG file; None: there is no colour.
        labels: (H, W) ids, of which `segments` says what they are; None: there are none.
    """

    stamp_ns: int
    T_map_camera: NDArray[np.float64]
    camera: Camera
    depth: NDArray[np.generic] | bytes
    depth_scale_m: float | None
    rgb: NDArray[np.uint8] | bytes | None
    labels: NDArray[np.generic] | None
    segments: list[Segment] | None

    def feed_to(self, feed: Feed) -> int:
        """The frame's sequence. The feed needs this camera and depth_scale_m."""
        return feed.rgbd(self.depth, self.rgb, self.labels, self.segments, self.T_map_camera, self.stamp_ns)


@dataclass(frozen=True, eq=False, slots=True)
class LidarFrame:
    """A scan, with what Feed.lidar takes: points_m (N, 3) in the LiDAR's frame, rgb (N, 3), segment_ids (N,).

    image: of a camera beside it, seen from where the LiDAR was; None: there is none, or it was not asked for.
    """

    stamp_ns: int
    T_map_lidar: NDArray[np.float64]
    points_m: NDArray[np.float32]
    rgb: NDArray[np.uint8] | None
    segment_ids: NDArray[np.generic] | None
    segments: list[Segment] | None
    image: LidarImage | None = None

    def feed_to(self, feed: Feed) -> int:
        """The frame's sequence."""
        return feed.lidar(self.points_m, self.T_map_lidar, self.stamp_ns, segment_ids=self.segment_ids,
                          segments=self.segments, rgb=self.rgb, image=self.image)
