# SPDX-License-Identifier: BSD-3-Clause
"""Messages that belong together become a frame."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dhpmap._camera import Camera
from dhpmap._errors import InvalidArgument
from dhpmap._frames import LidarImage, Segment
from dhpmap.mcap._clouds import ids_of, points_of, records_of, rgb_of
from dhpmap.mcap._frame import LidarFrame, RgbdFrame
from dhpmap.mcap._images import MILLIMETRE_M, camera_of, color_of, depth_of, labels_of
from dhpmap.mcap._messages import CameraInfo, Detections, Image, PointCloud
from dhpmap.mcap._options import FrameOptions
from dhpmap.mcap._segments import segments_of_classes, segments_of_detections
from dhpmap.mcap._topics import Chosen

# Names that label sets give to what has no class.
NO_CLASS = frozenset({"", "unlabeled", "unlabelled", "background", "__background__", "void", "ignore", "unknown"})

Labelled = tuple[NDArray[np.generic] | None, list[Segment] | None]


class Builder:
    """Makes frames of a recording's messages. names: of classes by id; a class of no name has none."""

    def __init__(self, chosen: Chosen, options: FrameOptions) -> None:
        self._chosen, self._options = chosen, options
        self._info: CameraInfo | None = None
        self._camera: Camera | None = None
        self.names: Mapping[int, str] = {}

    def set_names(self, names: Mapping[int, str]) -> None:
        self.names = {number: name for number, name in names.items() if name.lower() not in NO_CLASS}

    def set_camera(self, info: CameraInfo) -> None:
        """Raises InvalidArgument if it is not as it was before."""
        if self._info is None:
            self._info = info
            self._camera = camera_of(info, self._chosen.camera_info, rectified=self._options.get("rectified", False),
                                     off_centre=self._options.get("off_centre", False))
        elif not (np.array_equal(info.K, self._info.K) and np.array_equal(info.P, self._info.P)
                  and np.array_equal(info.distortion, self._info.distortion)):
            raise InvalidArgument(f"{self._chosen.camera_info}: the camera changes at stamp {info.stamp_ns}; feed the "
                                  "parts in sessions of their own")

    def rgbd(self, depth: Image, others: Mapping[str, Any], T_map_camera: NDArray[np.float64]) -> RgbdFrame:
        if self._camera is None:
            raise InvalidArgument(f"{self._chosen.camera_info} has no message")
        chosen = self._chosen
        self._check(depth, chosen.lead, depth.frame_id)
        color, labels = others.get(chosen.color), others.get(chosen.labels)
        for image, topic in ((color, chosen.color), (labels, chosen.labels)):
            if image is not None:
                self._check(image, topic, depth.frame_id)
        pixels = depth_of(depth, chosen.lead)
        in_metres = isinstance(pixels, np.ndarray) and pixels.dtype.kind == "f"
        ids, segments = self._labelled(labels_of(labels, chosen.labels), others) if labels is not None else (None, None)
        return RgbdFrame(depth.stamp_ns, T_map_camera, self._camera, pixels, None if in_metres else MILLIMETRE_M,
                         color_of(color, chosen.color) if color is not None else None, ids, segments)

    def lidar(self, cloud: PointCloud, others: Mapping[str, Any], T_map_lidar: NDArray[np.float64],
              T_map_camera: NDArray[np.float64] | None) -> LidarFrame:
        """T_map_camera: when the image was taken; None: there is none."""
        topic, label_field = self._chosen.lead, self._options.get("label_field", "")
        points = records_of(cloud, topic)
        points_m, is_return = points_of(points, topic)
        rgb, ids, segments = rgb_of(points), None, None
        if label_field:
            ids, segments = self._labelled(ids_of(points, label_field, topic)[is_return], others)
        image = None
        if T_map_camera is not None:
            image, seen = self._beside(others, np.linalg.inv(T_map_camera) @ T_map_lidar)
            segments = seen if image.labels is not None else segments
            rgb = rgb if image.rgb is None else None
        return LidarFrame(cloud.stamp_ns, T_map_lidar, points_m, None if rgb is None else rgb[is_return], ids, segments,
                          image)

    def _beside(self, others: Mapping[str, Any], T_camera_lidar: NDArray[np.float64]
                ) -> tuple[LidarImage, list[Segment] | None]:
        """The images beside a cloud, and what their labels are."""
        chosen = self._chosen
        if self._camera is None:
            raise InvalidArgument(f"{chosen.camera_info} has no message")
        color, labels = others.get(chosen.color), others.get(chosen.labels)
        for image, topic in ((color, chosen.color), (labels, chosen.labels)):
            if image is not None:
                self._check_size(image, topic)
        if color is not None and labels is not None and color.frame_id.lstrip("/") != labels.frame_id.lstrip("/"):
            raise InvalidArgument(f"{chosen.color} is in frame {color.frame_id!r}, {chosen.labels} in "
                                  f"{labels.frame_id!r}: images beside a cloud are of one camera")
        ids, segments = self._labelled(labels_of(labels, chosen.labels), others) if labels is not None else (None, None)
        its = self._camera
        K = np.array([[its.fx_px, 0, its.cx_px], [0, its.fy_px, its.cy_px], [0, 0, 1]])
        return LidarImage(K @ T_camera_lidar[:3], color_of(color, chosen.color) if color is not None else None, ids,
                          its.shape), segments

    def _labelled(self, ids: NDArray[np.generic], others: Mapping[str, Any]) -> Labelled:
        table = others.get(self._chosen.label_table)
        if isinstance(table, Detections):
            return segments_of_detections(ids, table, self.names, self._chosen.label_table)
        if not self.names:
            raise InvalidArgument(f"{self._chosen.label_table or 'classes'} names no class before the first labels: "
                                  "say classes={1: 'chair', ...}")
        return segments_of_classes(ids, self.names, self._options.get("label_divisor", 0))

    def _check(self, image: Image, topic: str, frame_id: str) -> None:
        """Pixel by pixel, images of a frame show the same."""
        assert self._camera is not None
        if image.frame_id.lstrip("/") != frame_id.lstrip("/"):
            raise InvalidArgument(f"{topic} is in frame {image.frame_id!r}, {self._chosen.lead} in {frame_id!r}: "
                                  "register depth to colour first, as depth_image_proc does")
        self._check_size(image, topic)

    def _check_size(self, image: Image, topic: str) -> None:
        assert self._camera is not None
        if not image.is_compressed and (image.height, image.width) != self._camera.shape:
            raise InvalidArgument(f"{topic} has {image.width} x {image.height} pixels, {self._chosen.camera_info} says "
                                  f"{self._camera.width_px} x {self._camera.height_px}")
