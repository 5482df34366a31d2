# SPDX-License-Identifier: BSD-3-Clause
"""Images of ROS 2 as arrays: depth, colour, labels."""
from __future__ import annotations

import importlib
import io

import numpy as np
from numpy.typing import NDArray

from dhpmap._camera import Camera
from dhpmap._errors import DataLoss, InvalidArgument, Unimplemented
from dhpmap.mcap._messages import CameraInfo, Image

MILLIMETRE_M = 0.001
MOST_PIXELS = 1 << 28
_CHANNELS = {"rgb8": (0, 1, 2), "bgr8": (2, 1, 0), "rgba8": (0, 1, 2), "bgra8": (2, 1, 0), "8UC3": (2, 1, 0)}
_GREY = ("mono8", "8UC1")
_LABELS = {"mono8": "u1", "8UC1": "u1", "mono16": "u2", "16UC1": "u2", "32SC1": "i4"}
_DEPTH_HEADER_BYTES = 12  # of compressed_depth_image_transport, before a PNG
_PNG = b"\x89PNG"

Pixels = NDArray[np.generic]


def depth_of(image: Image, topic: str) -> Pixels | bytes:
    """uint16 millimetres, float32 metres, or a PNG of millimetres as it is."""
    if image.is_compressed:
        if "16UC1" not in image.encoding:
            raise Unimplemented(f"{topic} is packed as {image.encoding!r}; depth may be 16UC1 as PNG "
                                "(compressedDepth), or not packed")
        data = bytes(image.data)
        packed = data if data.startswith(_PNG) else data[_DEPTH_HEADER_BYTES:]
        if not packed.startswith(_PNG):
            raise Unimplemented(f"{topic} is packed otherwise than as PNG, which compressedDepth has by default")
        return packed
    if image.encoding in ("16UC1", "mono16"):
        return _pixels(image, "u2", 1, topic)[..., 0]
    if image.encoding == "32FC1":
        metres = _pixels(image, "f4", 1, topic)[..., 0].astype(np.float32)
        metres[~np.isfinite(metres)] = 0  # of what is too far, as well as of no return
        return metres
    raise InvalidArgument(f"{topic} is of {image.encoding!r}; depth is 16UC1 (millimetres) or 32FC1 (metres)")


def color_of(image: Image, topic: str) -> NDArray[np.uint8] | bytes:
    """(H, W, 3), or a JPEG or PNG file as it is."""
    if image.is_compressed:
        if not bytes(image.data[:4]).startswith((_PNG, b"\xff\xd8\xff")):
            raise Unimplemented(f"{topic} is packed as {image.encoding!r}; colour may be JPEG, PNG, or not packed")
        return bytes(image.data)
    if image.encoding in _GREY:
        return np.repeat(_pixels(image, "u1", 1, topic), 3, axis=2).astype(np.uint8, copy=False)
    if image.encoding not in _CHANNELS:
        raise InvalidArgument(f"{topic} is of {image.encoding!r}; colour may be mono8, {', '.join(_CHANNELS)}")
    channels = 4 if "a8" in image.encoding else 3
    pixels = _pixels(image, "u1", channels, topic)[..., list(_CHANNELS[image.encoding])]
    return np.ascontiguousarray(pixels).astype(np.uint8, copy=False)


def labels_of(image: Image, topic: str) -> Pixels:
    """Integers (H, W)."""
    if image.is_compressed:
        pixels = _unpacked(image, topic)
        if pixels.ndim != 2 or pixels.dtype.kind not in "iu":
            raise InvalidArgument(f"{topic} has {pixels.ndim} axes of {pixels.dtype}; labels are one integer a pixel")
        return pixels
    if image.encoding not in _LABELS:
        raise InvalidArgument(f"{topic} is of {image.encoding!r}; labels may be {', '.join(_LABELS)}")
    return _pixels(image, _LABELS[image.encoding], 1, topic)[..., 0]


def camera_of(info: CameraInfo, topic: str, *, rectified: bool, off_centre: bool) -> Camera:
    """Raises InvalidArgument if the camera distorts, or its images are binned or cropped."""
    if info.is_cropped:
        raise InvalidArgument(f"{topic}: the images are binned or cropped, for which K does not hold")
    if not rectified and np.any(info.distortion != 0):
        raise InvalidArgument(f"{topic}: the camera distorts (d = {info.distortion.round(4).tolist()}): rectify the "
                              "images, as image_proc does, and register depth to them; of rectified images say "
                              "rectified=True")
    K = info.P[:, :3] if rectified else info.K
    if not (K[0, 0] > 0 and K[1, 1] > 0):
        raise InvalidArgument(f"{topic}: the camera is not calibrated: {'P' if rectified else 'K'} is {K.tolist()}")
    return Camera(info.width, info.height, float(K[0, 0]), float(K[1, 1]), float(K[0, 2]), float(K[1, 2]), off_centre)


def _pixels(image: Image, dtype: str, channels: int, topic: str) -> Pixels:
    """(H, W, channels), without the padding of its rows."""
    size = np.dtype(dtype).itemsize * channels
    wanted, height = image.width * size, image.height
    if image.step < wanted or image.step * height > len(image.data) or image.width * height > MOST_PIXELS:
        raise DataLoss(f"{topic} has a damaged image: {image.width} x {height} of {image.encoding} in rows of "
                       f"{image.step} bytes do not fit {len(image.data)} bytes")
    rows = np.frombuffer(image.data, np.uint8, image.step * height).reshape(height, image.step)[:, :wanted]
    order = ">" if image.is_bigendian else "<"
    pixels = np.ascontiguousarray(rows).view(order + dtype)
    return pixels.reshape(height, image.width, channels).astype(dtype, copy=False)


def _unpacked(image: Image, topic: str) -> Pixels:
    try:
        pillow = importlib.import_module("PIL.Image")
    except ImportError:
        raise Unimplemented(f"{topic} is packed as {image.encoding!r}: install python3-pil (or pip install pillow)"
                            ) from None
    if not bytes(image.data[:4]) == _PNG:
        raise InvalidArgument(f"{topic} is packed as {image.encoding!r}; labels must be packed without loss, as PNG")
    try:
        with pillow.open(io.BytesIO(image.data)) as opened:
            pixels: Pixels = np.asarray(opened)
    except (OSError, ValueError, SyntaxError) as error:
        raise DataLoss(f"{topic} has a damaged image: {error}") from None
    return pixels.astype(np.uint16) if pixels.dtype == np.int32 else pixels  # what Pillow makes of 16 bits
