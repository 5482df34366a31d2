# SPDX-License-Identifier: BSD-3-Clause
"""Maps as files: backups, exports and imports."""
from __future__ import annotations

import pathlib
from collections.abc import Iterator
from typing import Protocol

import grpc

from dhpmap._call import Caller
from dhpmap._errors import error_of_rpc
from dhpmap.v1 import map_service_pb2 as pb2

CHUNK_BYTES = 256 << 10


class Part(Protocol):
    """A message that holds the next part of a file."""

    data: bytes


def write_parts(path: str | pathlib.Path, parts: Iterator[Part]) -> int:
    """Writes a file that is there as a whole or not at all; its bytes."""
    path = pathlib.Path(path)
    unfinished = path.with_name(path.name + ".part")
    try:
        with open(unfinished, "wb") as file:
            for part in parts:
                file.write(part.data)
            num_bytes = file.tell()
        unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)
    return num_bytes


def import_map(caller: Caller, path: str | pathlib.Path, name: str, deadline_s: float) -> str:
    """The name of the map that is there now."""
    num_bytes = pathlib.Path(path).stat().st_size  # a file that is not there raises here, not on gRPC's thread

    def requests() -> Iterator[bytes]:
        yield pb2.ImportMapRequest(map_id=name, total_bytes=num_bytes).SerializeToString()
        with open(path, "rb") as file:
            while part := file.read(CHUNK_BYTES):
                yield pb2.ImportMapRequest(data=part).SerializeToString()

    call = caller.open("MapService/ImportMap", "stream_unary")
    try:
        answer = call(requests(), timeout=deadline_s, metadata=caller.metadata)
    except grpc.RpcError as failed:
        raise error_of_rpc(failed, caller.address) from None
    return pb2.ImportMapResponse.FromString(answer).map.name
