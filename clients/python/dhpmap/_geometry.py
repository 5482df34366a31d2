# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces and voxels of objects as arrays."""
from __future__ import annotations

import pathlib
import re
from dataclasses import dataclass, field

import numpy as np
from google.protobuf.message import DecodeError
from numpy.typing import NDArray

from dhpmap._call import Caller
from dhpmap._objects import ObjectLike, submap_name
from dhpmap._wire import read_columns
from dhpmap.v1 import submap_service_pb2 as pb2

_VERTEX = np.dtype([("place", "<f4", 3), ("normal", "<f4", 3), ("rgb", "u1", 3), ("class_id", "<u2"),
                    ("object_id", "<u4")])
_TRIANGLE = np.dtype([("count", "u1"), ("vertices", "<i4", 3)])
_COUNTS = re.compile(rb"element vertex (\d+)\n.*element face (\d+)\n", re.DOTALL)


@dataclass(frozen=True, eq=False, slots=True)
class Mesh:
    """A surface of triangles, in the map frame.

    Attributes:
        vertices_m: (N, 3).
        normals: (N, 3) unit, to the front.
        rgb: (N, 3).
        class_id: (N,).
        object_id: (N,).
        triangles: (M, 3) vertices, counterclockwise from the front.
        ply: the file that it was read from.
    """

    vertices_m: NDArray[np.float32]
    normals: NDArray[np.float32]
    rgb: NDArray[np.uint8]
    class_id: NDArray[np.int64]
    object_id: NDArray[np.int64]
    triangles: NDArray[np.int32]
    revision: int
    ply: bytes = field(repr=False)

    def save(self, path: str | pathlib.Path) -> None:
        """Writes a binary PLY file."""
        pathlib.Path(path).write_bytes(self.ply)

    def __repr__(self) -> str:
        return (f"<Mesh of {len(self.vertices_m)} vertices and {len(self.triangles)} triangles, "
                f"revision {self.revision}>")


@dataclass(frozen=True, eq=False, slots=True)
class Voxels:
    """The observed voxels of an object, but for what has been looked through since.

    Attributes:
        center_m: (N, 3) in the map frame.
        tsdf_m: (N,) truncated signed distance.
        weight: (N,).
        rgb: (N, 3).
        class_id: (N,) most seen class.
        class_confidence: (N,).
    """

    center_m: NDArray[np.float32]
    tsdf_m: NDArray[np.float32]
    weight: NDArray[np.float32]
    rgb: NDArray[np.uint8]
    class_id: NDArray[np.int64]
    class_confidence: NDArray[np.float32]
    revision: int

    def __len__(self) -> int:
        return len(self.tsdf_m)


def read_mesh(caller: Caller, map_name: str, read_revision: int, thing: ObjectLike | None,
              deadline_s: float | None) -> Mesh:
    name = map_name if thing is None else submap_name(map_name, thing)
    request = pb2.GetSubmapMeshRequest(name=name, format=pb2.GetSubmapMeshRequest.PLY, read_revision=read_revision)
    parts, revision = [], 0
    for message in caller.stream("SubmapService/GetSubmapMesh", request, pb2.GetSubmapMeshResponse,
                                 deadline_s=deadline_s):
        parts.append(message.data)
        revision = revision or message.revision
    return mesh_of_ply(b"".join(parts), revision)


def mesh_of_ply(ply: bytes, revision: int) -> Mesh:
    header, found, body = ply.partition(b"end_header\n")
    counts = _COUNTS.search(header)
    if not found or counts is None:
        raise DecodeError("the mesh is no PLY file")
    num_vertices, num_triangles = int(counts.group(1)), int(counts.group(2))
    if len(body) != num_vertices * _VERTEX.itemsize + num_triangles * _TRIANGLE.itemsize:
        raise DecodeError("the mesh is cut off, or of a newer server")
    vertices = np.frombuffer(body, _VERTEX, num_vertices)
    triangles = np.frombuffer(body, _TRIANGLE, num_triangles, offset=num_vertices * _VERTEX.itemsize)
    return Mesh(vertices["place"], vertices["normal"], vertices["rgb"], vertices["class_id"].astype(np.int64),
                vertices["object_id"].astype(np.int64), triangles["vertices"], revision, ply)


def read_voxels(caller: Caller, map_name: str, read_revision: int, thing: ObjectLike, max_abs_tsdf_m: float,
                deadline_s: float | None) -> Voxels:
    request = pb2.StreamSubmapVoxelsRequest(name=submap_name(map_name, thing), max_abs_tsdf_m=max_abs_tsdf_m,
                                            read_revision=read_revision)
    answers = caller.raw_stream("SubmapService/StreamSubmapVoxels", request.SerializeToString(), deadline_s=deadline_s)
    parts = [read_columns(memoryview(data), pb2.StreamSubmapVoxelsResponse.DESCRIPTOR) for data in answers]

    def column(name: str) -> NDArray[np.generic]:
        return np.concatenate([part[name] for part in parts]) if parts else np.empty(0)

    revision = int(parts[0]["revision"][0]) if parts else 0
    return Voxels(column("xyz_m").astype(np.float32).reshape(-1, 3), column("tsdf_m").astype(np.float32),
                  column("weight").astype(np.float32), column("rgb").astype(np.uint8).reshape(-1, 3),
                  column("class_id").astype(np.int64), column("class_confidence").astype(np.float32), revision)
