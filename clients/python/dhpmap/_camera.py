# SPDX-License-Identifier: BSD-3-Clause
"""Depth cameras, and what their images must be like."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dhpmap._arrays import numbers
from dhpmap._errors import bad_argument
from dhpmap.v1 import mapping_service_pb2 as pb2

LEAST_OFF_EDGE = 0.3  # of the image's size: a principal point nearer to an edge is likely of another image size
MOST_METRES = 200.0   # a median depth beyond it is likely in millimetres


@dataclass(frozen=True, slots=True)
class Camera:
    """A pinhole camera without distortion; pixels. The centre of the upper left pixel is 0, 0.

    Raises InvalidArgument where the principal point is far from the middle of the image, as intrinsics of another image
    size have it; `off_centre=True` says that it is so, as of a cropped image.
    """

    width_px: int
    height_px: int
    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float
    off_centre: bool = False

    def __post_init__(self) -> None:
        for name in ("width_px", "height_px", "fx_px", "fy_px"):
            if not getattr(self, name) > 0:
                raise bad_argument(name, f"{getattr(self, name)} is not above 0")
        for name, center, size in (("cx_px", self.cx_px, self.width_px), ("cy_px", self.cy_px, self.height_px)):
            if not (self.off_centre or LEAST_OFF_EDGE <= center / size <= 1 - LEAST_OFF_EDGE):
                factor = round(2 * center / size, 2)
                raise bad_argument(name, f"{center:g} is far from the middle of {size} pixels: are the intrinsics of "
                                         f"an image {factor:g} times as large? Scale them by "
                                         f"{1 / max(factor, 0.01):.3g}, or say off_centre=True")

    @staticmethod
    def from_matrix(K: ArrayLike, width_px: int, height_px: int) -> Camera:
        """Of the 3 x 3 matrix [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]."""
        matrix = numbers("camera", K)
        if matrix.shape != (3, 3):
            raise bad_argument("camera", f"wanted a dhpmap.Camera or a 3 x 3 matrix, got shape {matrix.shape}")
        if not np.allclose(matrix[2], (0, 0, 1)) or abs(matrix[1, 0]) > 1e-6:
            raise bad_argument("camera", f"{matrix.tolist()} is no matrix [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]")
        if abs(matrix[0, 1]) > 1e-3 * matrix[0, 0]:
            raise bad_argument("camera", f"has a skew of {matrix[0, 1]:g}; rectify the images")
        return Camera(width_px, height_px, *matrix[[0, 1, 0, 1], [0, 1, 2, 2]].tolist())

    @property
    def shape(self) -> tuple[int, int]:
        """(height, width) of its images."""
        return self.height_px, self.width_px


def camera_message(camera: Camera) -> pb2.PinholeCamera:
    return pb2.PinholeCamera(width_px=camera.width_px, height_px=camera.height_px, fx_px=camera.fx_px,
                             fy_px=camera.fy_px, cx_px=camera.cx_px, cy_px=camera.cy_px)


def depth_image(depth: ArrayLike, shape: tuple[int, int], scale_m: float | None) -> pb2.Image:
    """Float metres, or 16-bit integers of scale_m metres a unit; or a file of these, whose size the server checks."""
    if isinstance(depth, bytes):
        if scale_m is None:
            raise bad_argument("depth_m", "is a file: say by feed(depth_scale_m=0.001) how many metres a unit is")
        return pb2.Image(encoding=pb2.Image.FILE, data=depth, scale_m=scale_m)
    image = _sized("depth_m", depth, shape)
    if image.dtype == np.uint16:
        if scale_m is None:
            raise bad_argument("depth_m", "is of uint16: say by feed(depth_scale_m=0.001) how many metres a unit is, "
                                          "or convert it to float metres")
        _check_range(image, scale_m, f" with depth_scale_m={scale_m:g}: of millimetres it is 0.001")
        return pb2.Image(encoding=pb2.Image.RAW_U16, data=_octets(image, "<u2"), scale_m=scale_m)
    if image.dtype.kind != "f":
        raise bad_argument("depth_m", f"wanted float metres or uint16, got {image.dtype}")
    if scale_m is not None:
        raise bad_argument("depth_m", "is of floats, which are metres: feed without depth_scale_m, or give uint16")
    _check_range(image, 1, ": divide millimetres by 1000")
    return pb2.Image(encoding=pb2.Image.RAW_F32, data=_octets(image, "<f4"))


def _check_range(image: NDArray[np.generic], scale_m: float, remedy: str) -> None:
    sample = image[::8, ::8].astype(np.float64) * scale_m
    sample = sample[np.isfinite(sample) & (sample > 0)]
    if sample.size and float(np.median(sample)) > MOST_METRES:
        raise bad_argument("depth_m", f"has a median of {float(np.median(sample)):.0f} m{remedy}")


def color_image(rgb: ArrayLike, shape: tuple[int, int]) -> pb2.Image:
    if isinstance(rgb, bytes):
        return pb2.Image(encoding=pb2.Image.FILE, data=rgb)
    image = np.asarray(rgb)
    if image.dtype != np.uint8 or image.shape != (*shape, 3):
        remedy = "; multiply by 255 and convert" if image.dtype.kind == "f" else ""
        raise bad_argument("rgb", f"wanted uint8 of shape {(*shape, 3)}, got {image.dtype} of {image.shape}"
                                  + remedy)
    return pb2.Image(encoding=pb2.Image.RAW_RGB8, data=_octets(image, "u1"))


def label_image(labels: ArrayLike, shape: tuple[int, int]) -> tuple[pb2.Image, int]:
    """The image in the smallest type that holds it, and the greatest id."""
    image = _sized("labels", labels, shape)
    if image.dtype.kind not in "iu":
        raise bad_argument("labels", f"wanted integer segment ids, got {image.dtype}")
    if image.dtype.kind == "i" and image.min() < 0:
        raise bad_argument("labels", "has ids below 0; 0 is no label")
    greatest = int(image.max())
    if greatest < 1 << 8:
        return pb2.Image(encoding=pb2.Image.RAW_U8, data=_octets(image, "u1")), greatest
    if greatest < 1 << 16:
        return pb2.Image(encoding=pb2.Image.RAW_U16, data=_octets(image, "<u2")), greatest
    if greatest >= 1 << 32:
        raise bad_argument("labels", f"id {greatest} takes more than 32 bits")
    return pb2.Image(encoding=pb2.Image.RAW_U32, data=_octets(image, "<u4")), greatest


def _sized(name: str, values: ArrayLike, shape: tuple[int, int]) -> NDArray[np.generic]:
    image = np.asarray(values)
    if image.shape != shape:
        remedy = "; transpose it" if image.shape == shape[::-1] else ""
        raise bad_argument(name, f"wanted (height, width) = {shape} of the camera, got {image.shape}{remedy}")
    return image


def _octets(image: NDArray[np.generic], dtype: str) -> bytes:
    return image.astype(dtype, copy=False).tobytes()
