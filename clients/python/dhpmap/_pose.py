# SPDX-License-Identifier: BSD-3-Clause
"""Rigid transforms: 4 x 4 matrices here, translation and quaternion in messages."""
from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dhpmap._arrays import frozen, numbers, rigid, vector
from dhpmap._errors import bad_argument
from dhpmap.v1 import types_pb2


def pose(x_m: float = 0, y_m: float = 0, z_m: float = 0, *, yaw_rad: float = 0,
         quaternion_xyzw: ArrayLike | None = None) -> NDArray[np.float64]:
    """A 4 x 4 transform: turned about z (or by a quaternion), then moved.

    `T_map_robot = dhpmap.pose(1, 2, yaw_rad=np.pi / 2)` takes points of the robot's frame to the map's.
    Raises InvalidArgument for a quaternion of zero length, or one beside a yaw.
    """
    matrix = np.eye(4)
    matrix[:3, 3] = vector("x_m, y_m, z_m", (x_m, y_m, z_m))
    if quaternion_xyzw is None:
        matrix[:2, :2] = [[np.cos(yaw_rad), -np.sin(yaw_rad)], [np.sin(yaw_rad), np.cos(yaw_rad)]]
    elif yaw_rad != 0:
        raise bad_argument("yaw_rad", "give a yaw or a quaternion, not both")
    else:
        matrix[:3, :3] = _rotation(vector("quaternion_xyzw", quaternion_xyzw, 4))
    return matrix


def _rotation(quaternion: NDArray[np.float64]) -> NDArray[np.float64]:
    norm = float(np.linalg.norm(quaternion))
    if norm < 1e-6:
        raise bad_argument("quaternion_xyzw", "its length is 0; without a turn it is 0, 0, 0, 1")
    x, y, z, w = quaternion / norm
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def _quaternion(rotation: NDArray[np.float64]) -> NDArray[np.float64]:
    """x, y, z, w: the eigenvector of the greatest eigenvalue of Bar-Itzhack's matrix, good for any rotation."""
    r = rotation
    k = np.array([[r[0, 0] - r[1, 1] - r[2, 2], 0, 0, 0],
                  [r[0, 1] + r[1, 0], r[1, 1] - r[0, 0] - r[2, 2], 0, 0],
                  [r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], r[2, 2] - r[0, 0] - r[1, 1], 0],
                  [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], np.trace(r)]])
    vectors = np.linalg.eigh(k)[1]  # reads the lower triangle
    quaternion: NDArray[np.float64] = vectors[:, -1]
    return quaternion


def vector_message(name: str, values: ArrayLike) -> types_pb2.Vector3:
    x, y, z = vector(name, values).tolist()
    return types_pb2.Vector3(x=x, y=y, z=z)


def read_vector(message: types_pb2.Vector3) -> NDArray[np.float64]:
    return frozen(np.array([message.x, message.y, message.z]))


def pose_message(name: str, values: ArrayLike) -> types_pb2.Pose:
    """Raises InvalidArgument unless it is rigid and right-handed."""
    matrix = rigid(name, values)
    x, y, z, w = _quaternion(matrix[:3, :3]).tolist()
    return types_pb2.Pose(translation_m=vector_message(name, matrix[:3, 3]),
                          rotation=types_pb2.Quaternion(x=x, y=y, z=z, w=w))


def read_pose(message: types_pb2.Pose) -> NDArray[np.float64]:
    matrix = np.eye(4)
    matrix[:3, 3] = read_vector(message.translation_m)
    if message.HasField("rotation"):
        q = message.rotation
        matrix[:3, :3] = _rotation(np.array([q.x, q.y, q.z, q.w]))
    return frozen(matrix)


def read_path(name: str, waypoints: ArrayLike) -> NDArray[np.float64]:
    """Waypoints as (H, 4, 4): from (H, 3) places, (H, 7) places and quaternions x, y, z, w, or (H, 4, 4)."""
    array = numbers(name, waypoints)
    if array.ndim == 2 and array.shape[1] == 3:
        matrices = np.tile(np.eye(4), (len(array), 1, 1))
        matrices[:, :3, 3] = array
        return matrices
    if array.ndim == 2 and array.shape[1] == 7:
        return np.stack([pose(*row[:3], quaternion_xyzw=row[3:]) for row in array])
    if array.ndim == 3 and array.shape[1:] == (4, 4):
        return np.stack([rigid(f"{name}[{i}]", matrix) for i, matrix in enumerate(array)])
    raise bad_argument(name, "wanted (H, 3) places x, y, z, (H, 7) with quaternions x, y, z, w, or (H, 4, 4) "
                             f"transforms, got shape {array.shape}")
