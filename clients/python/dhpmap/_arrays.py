# SPDX-License-Identifier: BSD-3-Clause
"""What users pass as arrays, looked at before it is sent: got, expected, remedy."""
from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dhpmap._errors import bad_argument

RIGID_TOLERANCE = 1e-3


def numbers(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """Real, finite numbers of any shape, as float64."""
    try:
        array = np.asarray(values)
        if array.dtype.kind not in "fiub" or array.dtype.kind == "b":
            raise TypeError
        array = array.astype(np.float64, copy=False)
    except (TypeError, ValueError):
        raise bad_argument(name, f"wanted an array of real numbers, got {_described(values)}") from None
    bad = ~np.isfinite(array)
    if bad.any():
        where = tuple(int(axis) for axis in np.argwhere(bad)[0])
        raise bad_argument(name, f"{array[where]} at index {list(where)} is no finite number; "
                                 "leave such rows out, e.g. by a[np.isfinite(a).all(axis=-1)]")
    return array


def _described(values: object) -> str:
    if isinstance(values, np.ndarray):
        return f"an array of {values.dtype} of shape {values.shape}"
    return f"a {type(values).__name__}"


def rows(name: str, values: ArrayLike, width: int, what: str) -> tuple[NDArray[np.float32], tuple[int, ...]]:
    """An array of shape (..., width) as (N, width), and the shape of the dots."""
    array = numbers(name, values)
    if array.size == 0 and array.ndim <= 1:
        array = array.reshape(0, width)
    if array.ndim == 0 or array.shape[-1] != width:
        hint = "; transpose it" if array.ndim == 2 and array.shape[0] == width else ""
        raise bad_argument(name, f"wanted shape (..., {width}), {what}, got {array.shape}{hint}")
    return array.reshape(-1, width).astype(np.float32), array.shape[:-1]


def vector(name: str, values: ArrayLike, width: int = 3) -> NDArray[np.float64]:
    array = numbers(name, values)
    if array.shape != (width,):
        raise bad_argument(name, f"wanted {width} numbers, got shape {array.shape}")
    return array


def rigid(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """A rigid, right-handed 4 x 4 transform."""
    matrix = numbers(name, values)
    if matrix.shape != (4, 4):
        raise bad_argument(name, f"wanted a 4 x 4 transform, got shape {matrix.shape}")
    if not np.allclose(matrix[3], (0, 0, 0, 1), atol=1e-9):
        hint = "; it looks transposed" if np.allclose(matrix[:, 3], (0, 0, 0, 1), atol=1e-9) else ""
        raise bad_argument(name, f"the last row is {matrix[3].tolist()}, not 0, 0, 0, 1{hint}")
    rotation = matrix[:3, :3]
    determinant = float(np.linalg.det(rotation))
    if np.allclose(rotation @ rotation.T, np.eye(3), atol=RIGID_TOLERANCE):
        if determinant > 0:
            return matrix
        raise bad_argument(name, "left-handed: its determinant is -1; negate one axis of the rotation")
    scale = abs(determinant) ** (1 / 3)
    raise bad_argument(name, f"not rigid: its rotation scales by {scale:.4g} or shears; "
                             "divide the scale out, or orthonormalise it (U @ Vt of its SVD)")


def positive(name: str, value: float) -> float:
    number = float(numbers(name, value))
    if number <= 0:
        raise bad_argument(name, f"{number:g} is not above 0")
    return number


def frozen(array: NDArray[np.float64]) -> NDArray[np.float64]:
    """Read-only, as what an answer says does not change."""
    array.setflags(write=False)
    return array
