# SPDX-License-Identifier: BSD-3-Clause
"""A connection to a server, and its maps."""
from __future__ import annotations

import pathlib
import socket
from collections.abc import Iterable, Iterator
from typing import Literal

import grpc

from dhpmap._call import Caller
from dhpmap._errors import Unavailable, bad_argument
from dhpmap._files import import_map, write_parts
from dhpmap._map import Map
from dhpmap._map_info import Label, MapInfo, label_message, read_info
from dhpmap._owner import OwnerCaller, Owners
from dhpmap.v1 import map_service_pb2 as pb2
from dhpmap.v1 import types_pb2

# As the command line's: a server that is dead or cut off is noticed, and one that comes back is found soon.
_CHANNEL_OPTIONS = (
    ("grpc.max_receive_message_length", -1),
    ("grpc.max_send_message_length", -1),
    ("grpc.keepalive_time_ms", 20_000),
    ("grpc.keepalive_timeout_ms", 20_000),
    ("grpc.http2.max_pings_without_data", 0),
    ("grpc.initial_reconnect_backoff_ms", 100),
    ("grpc.max_reconnect_backoff_ms", 2_000),
    ("grpc.use_local_subchannel_pool", 1),
)


class Server:
    """A server's maps by name: `server["apartment"]`, `for m in server`. Safe for use from several threads.

    Close it, or use it in a `with` block. A process that forks connects anew in the child.
    """

    def __init__(self, caller: Caller, author: str, owners: Owners | None = None) -> None:
        self._caller, self._author, self._owners = caller, author, owners

    def __getitem__(self, name: str) -> Map:
        """Raises NotFound (reason MAP_NOT_FOUND), which names the maps that there are."""
        found = self._map(name)
        try:
            found.info
        except LookupError as error:
            names = ", ".join(info.name for info in self.list()) or "none"
            error.args = (f"{error.args[0]}; the server's maps: {names}",)
            raise
        return found

    def __iter__(self) -> Iterator[Map]:
        return (self._map(info.name) for info in self.list())

    def __contains__(self, name: object) -> bool:
        return any(info.name == name for info in self.list())

    def list(self) -> list[MapInfo]:
        """All maps by name, without their classes."""
        request, found = pb2.ListMapsRequest(), []
        while True:
            page = self._caller.unary("MapService/ListMaps", request, pb2.ListMapsResponse)
            found += [read_info(message) for message in page.maps]
            if not page.next_page_token:
                return found
            request.page_token = page.next_page_token

    def create(self, name: str, classes: Iterable[Label] = (), *, title: str = "",
               preset: Literal["indoor", "outdoor_lidar"] = "indoor", voxel_size_m: float | None = None,
               truncation_m: float | None = None) -> Map:
        """A new, empty map. classes: its label set, by which frames name classes; without any they may name none.

        Raises AlreadyExists, InvalidArgument (with every field that is wrong in `violations`).
        """
        config = types_pb2.MapConfig(voxel_size_m=voxel_size_m, truncation_m=truncation_m)
        request = pb2.CreateMapRequest(map_id=name, display_name=title, preset=preset, config=config,
                                       label_classes=map(label_message, classes))
        self._caller.unary("MapService/CreateMap", request, pb2.CreateMapResponse, again=False)
        return self._map(name)

    def delete(self, name: str) -> None:
        """Deletes a map with all that is in it. Raises FailedPrecondition while it is fed, NotFound."""
        self._caller.unary("MapService/DeleteMap", pb2.DeleteMapRequest(name=_resource_name(name)),
                           pb2.DeleteMapResponse, again=False)

    def backup(self, path: str | pathlib.Path, *, deadline_s: float = 3600) -> int:
        """Writes all maps as they are stored into a database file that a server starts on; its bytes."""
        return write_parts(path, self._caller.stream("MapService/BackupMaps", pb2.BackupMapsRequest(),
                                                     pb2.BackupMapsResponse, deadline_s=deadline_s))

    def import_map(self, path: str | pathlib.Path, name: str = "", *, deadline_s: float = 3600) -> Map:
        """Takes in a file of Map.export, under its own name or another. Raises AlreadyExists."""
        return self._map(import_map(self._caller, path, name, deadline_s))

    def close(self) -> None:
        """Ends the connection."""
        self._caller.close()
        if self._owners is not None:
            self._owners.close()

    def _map(self, name: str) -> Map:
        caller = self._caller if self._owners is None else OwnerCaller(self._caller, self._owners)
        return Map(caller, _resource_name(name), self._author)

    def __enter__(self) -> Server:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<dhpmap.Server {self._caller.address}>"


def _resource_name(name: str) -> str:
    if not isinstance(name, str):
        raise bad_argument("name", f"wanted the name of a map, got {name!r}")
    return name if name.startswith("maps/") else f"maps/{name}"


def _read_token(path: pathlib.Path) -> str:
    if path.stat().st_mode & 0o077:
        raise bad_argument("token_file", f"{path} is open to others than its owner: chmod 600 it")
    token = path.read_text("ascii").strip()
    if not token or len(token.split()) != 1:
        raise bad_argument("token_file", f"{path} holds no key")
    return token


def _read_roots(ca: str | pathlib.Path, tls: bool | bytes) -> bytes:
    if isinstance(tls, bytes):
        raise bad_argument("ca", "says whom to trust, and so does tls: give one of them")
    roots = pathlib.Path(ca).read_bytes()
    if b"BEGIN CERTIFICATE" not in roots:  # an empty one would mean no TLS at all
        raise bad_argument("ca", f"{ca} is no certificate in PEM")
    return roots


def _why_silent(address: str) -> str:
    host, _, port = address.rpartition(":")
    try:
        with socket.create_connection((host.strip("[]"), int(port)), 1) as wire:
            wire.sendall(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
            if wire.recv(9) == b"HTTP/1.1 ":
                return "an HTTP server is there, such as the REST door: the gRPC door has another port, by default 50051"
    except (OSError, ValueError):
        return "is dhpmap-server running there?"
    return "something is there, which speaks no gRPC or wants TLS: connect(ca=...)"


def _may_dial(address: str, token: str, tls: bool | bytes) -> bool:
    """A key goes over TLS, or to this machine."""
    is_local = address.split(":")[0] in ("localhost", "127.0.0.1", "unix") or address.startswith("[::1]")
    return bool(not token or tls or is_local)


def _channel_to(address: str, tls: bool | bytes) -> grpc.Channel:
    if not tls:
        return grpc.insecure_channel(address, _CHANNEL_OPTIONS)
    return grpc.secure_channel(address, grpc.ssl_channel_credentials(None if tls is True else tls), _CHANNEL_OPTIONS)


def connect(address: str = "127.0.0.1:50051", *, deadline_s: float = 30, connect_s: float = 5, token: str = "",
            token_file: str | pathlib.Path = "", tls: bool | bytes = False, ca: str | pathlib.Path = "",
            author: str = "", to_owner: bool = True) -> Server:
    """Connects to a server's gRPC door.

    deadline_s: how long each call may take, lost connections included. connect_s: how long to wait for the server.
    tls: True for the system's roots, or PEM bytes of others; ca: a file that has these. token: your key, sent with
    every call, over TLS or to this machine only; token_file: a file of mode 600 that holds it. author: who edits,
    unless an edit says so; where keys are on your own name, or one that begins with it and a slash. to_owner: of
    several servers on one database, calls about a map go to the one that owns it, once an answer has told which that
    is and it can be reached from here; else all go by this one.

    Raises Unavailable if no server answers, OSError if the file cannot be read.
    """
    if token_file:
        if token:
            raise bad_argument("token_file", "give a token or a file with it, not both")
        token = _read_token(pathlib.Path(token_file))
    if ca:
        tls = _read_roots(ca, tls)
    if not _may_dial(address, token, tls):
        raise bad_argument("token", f"would go to {address} in the clear: connect with tls=True or ca=")

    def dial(other: str) -> Caller:
        return Caller(_channel_to(other, tls), other, deadline_s, token)

    caller = dial(address)
    if not caller.is_ready(connect_s):
        caller.close()
        raise Unavailable(f"no server answers at {address} within connect_s={connect_s:g}; " + _why_silent(address))
    owners = Owners(lambda other: dial(other) if _may_dial(other, token, tls) else None) if to_owner else None
    return Server(caller, author, owners)
