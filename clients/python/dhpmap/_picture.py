# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of arrays, without a library."""
from __future__ import annotations

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

FREE, UNKNOWN, OCCUPIED = (255, 255, 255), (205, 205, 205), (40, 40, 40)


def png_of(rgb: NDArray[np.uint8]) -> bytes:
    """A PNG file of (H, W, 3)."""
    height, width, _ = rgb.shape
    lines = np.zeros((height, 1 + 3 * width), np.uint8)  # each begins with its filter: none
    lines[:, 1:] = rgb.reshape(height, -1)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(lines.tobytes())) + chunk(b"IEND", b""))


def slice_colors(cells: NDArray[np.int8], object_id: NDArray[np.int64] | None) -> NDArray[np.uint8]:
    """(H, W) seen from above with y up; a colour an object, where that is known."""
    rgb = np.empty((*cells.shape, 3), np.uint8)
    rgb[:], rgb[cells == 0], rgb[cells == 100] = UNKNOWN, FREE, OCCUPIED
    if object_id is not None:
        owned = object_id > 0
        rgb[owned] = colors_of(object_id[owned])
    return _enlarged(rgb)


def distance_colors(distance_m: NDArray[np.float32], known: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """(H, W) seen from above with y up: red inside of things, white at surfaces, the bluer the farther."""
    reach_m = max(float(np.abs(distance_m).max(initial=0)), 1e-6)
    pale = 255 * (1 - np.clip(np.abs(distance_m) / reach_m, 0, 1))[..., np.newaxis]
    rgb = np.where((distance_m < 0)[..., np.newaxis], np.concatenate([0 * pale + 220, pale, pale], axis=-1),
                   np.concatenate([pale, pale, 0 * pale + 255], axis=-1)).astype(np.uint8)
    rgb[~known] = (rgb[~known] // 2 + 80).astype(np.uint8)
    return _enlarged(rgb)


def _enlarged(rgb: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """y up, and some 400 pixels wide where it is smaller."""
    factor = max(1, 400 // max(rgb.shape[1], 1))
    return rgb[::-1].repeat(factor, axis=0).repeat(factor, axis=1)


def colors_of(ids: NDArray[np.int64]) -> NDArray[np.uint8]:
    """(N, 3) a colour a number, far from those of its neighbours, none of them pale."""
    hue = (ids * 0.61803398875) % 1.0 * 6.0
    ramp = np.abs((hue[:, np.newaxis] + (0.0, 4.0, 2.0)) % 6.0 - 3.0) - 1.0
    colors: NDArray[np.uint8] = (40 + 160 * np.clip(ramp, 0, 1)).astype(np.uint8)
    return colors
