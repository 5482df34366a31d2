# SPDX-License-Identifier: BSD-3-Clause
"""Clouds of ROS 2 as arrays."""
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dhpmap._errors import DataLoss, InvalidArgument
from dhpmap.mcap._messages import PointCloud

_DTYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}


def records_of(cloud: PointCloud, topic: str) -> NDArray[np.void]:
    """(N,), with the cloud's fields by name."""
    order = ">" if cloud.is_bigendian else "<"
    names, formats, offsets = [], [], []
    for its in cloud.fields:
        if its.datatype not in _DTYPES or its.count not in (0, 1):
            continue  # of no use here: a histogram, say
        dtype = np.dtype(order + _DTYPES[its.datatype])
        if its.offset + dtype.itemsize > cloud.point_step:
            raise DataLoss(f"{topic} has a damaged cloud: field {its.name!r} reaches beyond a point")
        if its.name not in names:
            names.append(its.name)
            formats.append(dtype)
            offsets.append(its.offset)
    if cloud.row_step * cloud.height > len(cloud.data) or cloud.point_step * cloud.width > cloud.row_step:
        raise DataLoss(f"{topic} has a damaged cloud: {cloud.width} x {cloud.height} points of {cloud.point_step} "
                       f"bytes do not fit {len(cloud.data)}")
    layout = np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": cloud.point_step})
    rows = np.frombuffer(cloud.data, np.uint8, cloud.row_step * cloud.height).reshape(cloud.height, cloud.row_step)
    points: NDArray[np.void] = np.ascontiguousarray(rows[:, :cloud.point_step * cloud.width]).reshape(-1).view(layout)
    return points


def points_of(records: NDArray[np.void], topic: str) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """(N, 3), and which records they are of: points that are not finite are no returns."""
    names = records.dtype.names or ()
    if not {"x", "y", "z"} <= set(names):
        raise InvalidArgument(f"{topic} has the fields {', '.join(names) or 'none'}; points need x, y and z")
    points = np.stack([records[axis].astype(np.float32) for axis in "xyz"], axis=-1)
    is_return = np.isfinite(points).all(axis=1)
    return points[is_return], is_return


def rgb_of(records: NDArray[np.void]) -> NDArray[np.uint8] | None:
    """(N, 3) of the field rgb or rgba, in whose 32 bits PCL packs a colour."""
    name = next((its for its in ("rgb", "rgba") if its in (records.dtype.names or ())), None)
    if name is None or records.dtype[name].itemsize != 4:
        return None
    order = records.dtype[name].byteorder
    word = np.ascontiguousarray(records[name]).view(f"{'>' if order == '>' else '<'}u4").astype(np.uint32)
    rgb: NDArray[np.uint8] = np.stack([(word >> shift) & 0xFF for shift in (16, 8, 0)], axis=-1).astype(np.uint8)
    return rgb


def ids_of(records: NDArray[np.void], name: str, topic: str) -> NDArray[np.uint32]:
    """(N,) of an integer field."""
    names = records.dtype.names or ()
    if name not in names or records.dtype[name].kind not in "iu":
        raise InvalidArgument(f"{topic} has no integer field {name!r}; its fields are {', '.join(names)}")
    ids = records[name].astype(np.int64)
    if ids.size and ids.min() < 0:
        raise InvalidArgument(f"{topic}: field {name!r} has ids below 0; 0 is no label")
    return ids.astype(np.uint32)
