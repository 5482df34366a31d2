# SPDX-License-Identifier: BSD-3-Clause
"""The messages of ROS 2 of which frames are made."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from dhpmap.mcap._cdr import Cdr

IMAGE = "sensor_msgs/msg/Image"
COMPRESSED_IMAGE = "sensor_msgs/msg/CompressedImage"
CAMERA_INFO = "sensor_msgs/msg/CameraInfo"
POINT_CLOUD = "sensor_msgs/msg/PointCloud2"
TF = "tf2_msgs/msg/TFMessage"
LABEL_INFO = "vision_msgs/msg/LabelInfo"
DETECTIONS = "vision_msgs/msg/Detection2DArray"


@dataclass(frozen=True, eq=False, slots=True)
class Image:
    """sensor_msgs/Image; of sensor_msgs/CompressedImage, `encoding` is its format, and there is no size."""

    stamp_ns: int
    frame_id: str
    height: int
    width: int
    encoding: str
    is_bigendian: bool
    step: int
    data: memoryview
    is_compressed: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class CameraInfo:
    """sensor_msgs/CameraInfo. is_cropped: is binned, or has a region of interest."""

    stamp_ns: int
    frame_id: str
    height: int
    width: int
    distortion: NDArray[np.float64]
    K: NDArray[np.float64]
    P: NDArray[np.float64]
    is_cropped: bool


@dataclass(frozen=True, slots=True)
class PointField:
    name: str
    offset: int
    datatype: int
    count: int


@dataclass(frozen=True, eq=False, slots=True)
class PointCloud:
    """sensor_msgs/PointCloud2."""

    stamp_ns: int
    frame_id: str
    height: int
    width: int
    fields: tuple[PointField, ...]
    is_bigendian: bool
    point_step: int
    row_step: int
    data: memoryview


@dataclass(frozen=True, eq=False, slots=True)
class Transform:
    """One of tf2_msgs/TFMessage: takes points of the child's frame to the parent's."""

    stamp_ns: int
    parent: str
    child: str
    translation_m: NDArray[np.float64]
    xyzw: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Detection:
    """One of vision_msgs/Detection2DArray, without its box. class_id: of the likeliest hypothesis; "": there is none.
    """

    id: str
    class_id: str
    score: float


@dataclass(frozen=True, slots=True)
class Detections:
    stamp_ns: int
    detections: tuple[Detection, ...]


def read_image(data: bytes) -> Image:
    cdr = Cdr(data, IMAGE)
    stamp_ns, frame_id = cdr.stamp_ns(), cdr.text()
    image = Image(stamp_ns, frame_id, cdr.u32(), cdr.u32(), cdr.text(), bool(cdr.u8()), cdr.u32(), cdr.octets())
    cdr.end()
    return image


def read_compressed_image(data: bytes) -> Image:
    cdr = Cdr(data, COMPRESSED_IMAGE)
    stamp_ns, frame_id, encoding, packed = cdr.stamp_ns(), cdr.text(), cdr.text(), cdr.octets()
    cdr.end()
    return Image(stamp_ns, frame_id, 0, 0, encoding, False, 0, packed, is_compressed=True)


def read_camera_info(data: bytes) -> CameraInfo:
    cdr = Cdr(data, CAMERA_INFO)
    stamp_ns, frame_id, height, width = cdr.stamp_ns(), cdr.text(), cdr.u32(), cdr.u32()
    cdr.text()  # the model of distortion
    distortion, K, _, P = cdr.f64s(cdr.count(8)), cdr.f64s(9), cdr.f64s(9), cdr.f64s(12)
    binning = (cdr.u32(), cdr.u32())
    x, y, roi_height, roi_width = cdr.u32(), cdr.u32(), cdr.u32(), cdr.u32()
    cdr.u8()
    cdr.end()
    is_cropped = max(binning) > 1 or x > 0 or y > 0 or (roi_height, roi_width) not in ((0, 0), (height, width))
    return CameraInfo(stamp_ns, frame_id, height, width, distortion, K.reshape(3, 3), P.reshape(3, 4), is_cropped)


def read_point_cloud(data: bytes) -> PointCloud:
    cdr = Cdr(data, POINT_CLOUD)
    stamp_ns, frame_id, height, width = cdr.stamp_ns(), cdr.text(), cdr.u32(), cdr.u32()
    fields = tuple(PointField(cdr.text(), cdr.u32(), cdr.u8(), cdr.u32()) for _ in range(cdr.count(13)))
    cloud = PointCloud(stamp_ns, frame_id, height, width, fields, bool(cdr.u8()), cdr.u32(), cdr.u32(), cdr.octets())
    cdr.u8()  # is_dense
    cdr.end()
    return cloud


def read_transforms(data: bytes) -> list[Transform]:
    cdr = Cdr(data, TF)
    read = [Transform(cdr.stamp_ns(), cdr.text().lstrip("/"), cdr.text().lstrip("/"), cdr.f64s(3), cdr.f64s(4))
            for _ in range(cdr.count(72))]
    cdr.end()
    return read


def read_label_info(data: bytes) -> dict[int, str]:
    """Names of classes by their ids."""
    cdr = Cdr(data, LABEL_INFO)
    cdr.stamp_ns()
    cdr.text()
    names = {cdr.u16(): cdr.text() for _ in range(cdr.count(6))}
    cdr.f32()  # the threshold
    cdr.end()
    return names


def read_detections(data: bytes) -> Detections:
    cdr = Cdr(data, DETECTIONS)
    stamp_ns = cdr.stamp_ns()
    cdr.text()
    read = []
    for _ in range(cdr.count(60)):
        cdr.stamp_ns()
        cdr.text()
        best = ("", 0.0)
        for _ in range(cdr.count(300)):
            class_id, score = cdr.text(), cdr.f64()
            cdr.f64s(7 + 36)  # a pose with its covariance
            if best[0] == "" or score > best[1]:
                best = (class_id, score)
        cdr.f64s(5)  # the box: centre, angle, sizes
        read.append(Detection(cdr.text(), *best))
    cdr.end()
    return Detections(stamp_ns, tuple(read))
