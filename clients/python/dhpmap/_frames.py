# SPDX-License-Identifier: BSD-3-Clause
"""Frames, checked and serialised."""
from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from dhpmap._arrays import numbers, rigid, rows
from dhpmap._camera import Camera, camera_message, color_image, depth_image, label_image
from dhpmap._errors import bad_argument
from dhpmap._wire import bytes_field, floats_field
from dhpmap.v1 import mapping_service_pb2 as pb2


@dataclass(frozen=True, slots=True)
class Segment:
    """What the panoptic segmentation says of one id of the label image.

    Attributes:
        id: not 0.
        class_name: or the id of the class; None: the likeliest of class_scores, else unknown.
        score: 0 to 1; None: none is known.
        class_scores: how likely each class is; in sum at most 1.
    """

    id: int
    class_name: str | int | None = None
    score: float | None = None
    class_scores: Mapping[str | int, float] = field(default_factory=dict)


@dataclass(frozen=True, eq=False, slots=True)
class LidarImage:
    """Images of a camera beside a LiDAR, of one size: points outside are dropped, the others take what they show.

    Attributes:
        P_image_lidar: (3, 4) takes points of the LiDAR's frame to pixels, pixel = P [p; 1].
        rgb: (H, W, 3) uint8; or the bytes of a JPEG or PNG file, which needs a shape.
        labels: (H, W) integer ids of segments, 0: none.
        shape: (H, W), of images that do not say.
    """

    P_image_lidar: ArrayLike
    rgb: ArrayLike | bytes | None = None
    labels: ArrayLike | None = None
    shape: tuple[int, int] | None = None


Segments = Iterable[Segment] | Mapping[int, str | int]


def segment_messages(segments: Segments, class_ids: Mapping[str, int]) -> list[pb2.Segment]:
    """Classes by name are looked up among the map's."""
    if isinstance(segments, Mapping):
        segments = [Segment(number, name) for number, name in segments.items()]
    out = []
    for its in segments:
        message = pb2.Segment(id=its.id, score=its.score)
        if its.class_name is not None:
            message.class_id = _class_id(its.class_name, class_ids)
        for name, score in its.class_scores.items():
            message.class_scores.add(class_id=_class_id(name, class_ids), score=score)
        out.append(message)
    return out


def unlisted_ids(labels: ArrayLike, segments: Segments) -> list[int]:
    """The ids of a label image that no segment has, as far as every 8th pixel tells, ascending."""
    listed = list(segments) if isinstance(segments, Mapping) else [its.id for its in segments]
    seen = np.unique(np.asarray(labels)[::8, ::8])
    unlisted: list[int] = seen[(seen != 0) & ~np.isin(seen, listed)].tolist()
    return unlisted


def _class_id(name: str | int, class_ids: Mapping[str, int]) -> int:
    if not isinstance(name, str):
        return int(name)
    if name not in class_ids:
        known = ", ".join(sorted(class_ids)[:20]) or "none"
        raise bad_argument("segments", f"the map has no class {name!r}; it has {known}")
    return class_ids[name]


def checked_stamp(stamp_ns: int, last_ns: int | None) -> int:
    if isinstance(stamp_ns, bool) or not isinstance(stamp_ns, (int, np.integer)):
        raise bad_argument("stamp_ns", f"wanted nanoseconds as an int, got {stamp_ns!r}; of seconds: int(t * 1e9)")
    if last_ns is not None and stamp_ns <= last_ns:
        verb = "repeats the stamp" if stamp_ns == last_ns else f"lies {(last_ns - stamp_ns) / 1e9:.6g} s before that"
        raise bad_argument("stamp_ns", f"{stamp_ns} {verb} of the frame before; stamps go up, in nanoseconds")
    return int(stamp_ns)


def rgbd_frame(camera: Camera, depth: ArrayLike, rgb: ArrayLike | None, labels: ArrayLike | None,
               segments: Segments | None, T_map_camera: ArrayLike, stamp_ns: int, *, scale_m: float | None,
               class_ids: Mapping[str, int], persistent_ids: bool) -> bytes:
    """A serialised pb2.Frame."""
    images = pb2.DepthCameraFrame(camera=camera_message(camera), depth=depth_image(depth, camera.shape, scale_m))
    if rgb is not None:
        images.color.CopyFrom(color_image(rgb, camera.shape))
    if (labels is None) != (segments is None):
        raise bad_argument("segments", "labels and segments come together: {1: 'chair', 2: 'wall'} says what the ids "
                                       "of the label image are")
    frame = _head(T_map_camera, "T_map_camera", stamp_ns, persistent_ids)
    if labels is not None and segments is not None:
        image, greatest = label_image(labels, camera.shape)
        images.segments.CopyFrom(image)
        if greatest > 0:
            frame.segments.extend(segment_messages(segments, class_ids))
    return frame.SerializeToString() + bytes_field(frame.DESCRIPTOR, "depth_camera", images.SerializeToString())


def lidar_frame(points_m: ArrayLike, segment_ids: ArrayLike | None, segments: Segments | None, rgb: ArrayLike | None,
                image: LidarImage | None, T_map_lidar: ArrayLike, stamp_ns: int, *,
                class_ids: Mapping[str, int], persistent_ids: bool) -> bytes:
    """A serialised pb2.Frame of one scan."""
    points, shape = rows("points_m", points_m, 3, "x, y, z in the LiDAR's frame, in metres")
    scan = pb2.LidarFrame()
    frame = _head(T_map_lidar, "T_map_lidar", stamp_ns, persistent_ids)
    labelled_by = [its for its in (segment_ids, image.labels if image else None) if its is not None]
    if len(labelled_by) != (0 if segments is None else 1):
        raise bad_argument("segments", "segments come with segment_ids, or with the labels of an image, "
                                       "and these with them")
    if segments is not None:
        frame.segments.extend(segment_messages(segments, class_ids))
    if image is not None:
        scan.camera.CopyFrom(_lidar_camera(image))
    if segment_ids is not None:
        ids = np.asarray(segment_ids)
        if ids.dtype.kind not in "iu" or ids.shape != shape:
            raise bad_argument("segment_ids", f"wanted integers of shape {shape}, got {ids.dtype} of {ids.shape}")
        scan.segment_ids.extend(ids.ravel().tolist())
    if rgb is not None:
        colors = np.asarray(rgb)
        if colors.dtype != np.uint8 or colors.shape != (*shape, 3):
            raise bad_argument("rgb", f"wanted uint8 of {(*shape, 3)}, got {colors.dtype} of {colors.shape}")
        scan.rgb = colors.tobytes()
    body = scan.SerializeToString() + floats_field(scan.DESCRIPTOR, "packed_points_m", points)
    return frame.SerializeToString() + bytes_field(frame.DESCRIPTOR, "lidar", body)


def _lidar_camera(image: LidarImage) -> pb2.LidarCamera:
    P = numbers("P_image_lidar", image.P_image_lidar)
    if P.shape != (3, 4):
        raise bad_argument("P_image_lidar", f"wanted a 3 x 4 matrix, got shape {P.shape}")
    seen = image.labels if image.labels is not None else image.rgb
    if seen is None:
        raise bad_argument("image", "has neither rgb nor labels")
    if isinstance(seen, bytes) and image.shape is None:
        raise bad_argument("image", "has a file for rgb, and no shape")
    height, width = image.shape or np.shape(seen)[:2]
    camera = pb2.LidarCamera(image_from_lidar=P.ravel().tolist(), width_px=width, height_px=height)
    if image.rgb is not None:
        camera.color.CopyFrom(color_image(image.rgb, (height, width)))
    if image.labels is not None:
        camera.segments.CopyFrom(label_image(image.labels, (height, width))[0])
    return camera


def _head(T_map_sensor: ArrayLike, name: str, stamp_ns: int, persistent_ids: bool) -> pb2.Frame:
    return pb2.Frame(stamp_ns=stamp_ns, map_from_sensor_matrix=rigid(name, T_map_sensor).ravel().tolist(),
                     persistent_ids=persistent_ids, allow_unlisted_ids=True)
