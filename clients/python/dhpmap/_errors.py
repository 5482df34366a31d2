# SPDX-License-Identifier: BSD-3-Clause
"""Errors: one class a status of the server, and the same for mistakes that are found before anything is sent."""
from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import grpc

from dhpmap.v1 import rpc_error_details_pb2 as details_pb2
from dhpmap.v1 import rpc_status_pb2 as status_pb2


@dataclass(frozen=True, slots=True)
class Violation:
    """What is wrong with one field of a request."""

    field: str
    description: str


class Error(Exception):
    """What failed, and why. Catch this one for all.

    Error
     +- InvalidArgument     a mistake in what was asked; also a ValueError
     +- NotFound            no such map, object or edit; also a LookupError
     +- AlreadyExists       the name is taken
     +- FailedPrecondition  not in this state of the map
     +- Aborted             something else came first: read again, then decide
     +- OutOfRange          a revision that is not kept, or is of another history
     +- ResourceExhausted   a bound was met: ask for less, or later
     +- PermissionDenied, Unauthenticated
     +- Unavailable         no server, or it is ending; also a ConnectionError
     +- DeadlineExceeded    it took longer than the deadline; also a TimeoutError
     +- Cancelled, DataLoss, Unimplemented, Internal, UnknownError

    Attributes:
        reason: a word for programs, such as "MAP_NOT_FOUND"; "" of an error that has none.
        metadata: what belongs to the reason, such as {"merged_into": "maps/a/submaps/3"}.
        violations: the fields that are wrong, all of them; the first also stands in the message.
    """

    def __init__(self, message: str, *, reason: str = "", metadata: Mapping[str, str] | None = None,
                 violations: Iterable[Violation] = ()) -> None:
        super().__init__(message)
        self.reason = reason
        self.metadata = dict(metadata or {})
        self.violations = tuple(violations)

    def __str__(self) -> str:
        message = str(self.args[0])
        return f"{message} [{self.reason}]" if self.reason else message


class InvalidArgument(Error, ValueError):
    """A mistake in what was asked: the message says what to change."""


class NotFound(Error, LookupError):
    """There is no such map, object or edit."""


class AlreadyExists(Error):
    """The name is taken."""


class FailedPrecondition(Error):
    """It cannot be done in this state of the map."""


class Aborted(Error):
    """Something else came first: an etag does not hold, an edit conflicts, a feed was taken over."""


class OutOfRange(Error):
    """A revision whose state is not kept, or that is of another history."""


class ResourceExhausted(Error):
    """A bound of the server was met."""


class PermissionDenied(Error):
    """The token does not allow this."""


class Unauthenticated(Error):
    """The server wants a token, or another one."""


class Unavailable(Error, ConnectionError):
    """No server answers, or it is ending."""


class DeadlineExceeded(Error, TimeoutError):
    """It took longer than the deadline."""


class Cancelled(Error):
    """The call was cancelled."""


class DataLoss(Error):
    """What is stored is damaged."""


class Unimplemented(Error):
    """The server is older than this client."""


class Internal(Error):
    """A fault of the server."""


class UnknownError(Error):
    """A failure of an unknown kind."""


_CLASSES: dict[int, type[Error]] = {
    1: Cancelled, 2: UnknownError, 3: InvalidArgument, 4: DeadlineExceeded, 5: NotFound, 6: AlreadyExists,
    7: PermissionDenied, 8: ResourceExhausted, 9: FailedPrecondition, 10: Aborted, 11: OutOfRange, 12: Unimplemented,
    13: Internal, 14: Unavailable, 15: DataLoss, 16: Unauthenticated,
}
_STATUS_KEY = "grpc-status-details-bin"


def error_of(code: int, message: str, status: bytes = b"") -> Error:
    """The error of a code of google.rpc.Code, with the details of a serialised google.rpc.Status."""
    reason, metadata = "", dict[str, str]()
    violations: list[Violation] = []
    for detail in status_pb2.Status.FromString(status).details:
        kind = detail.type_url.rpartition("/")[2]
        if kind == "google.rpc.ErrorInfo":
            info = details_pb2.ErrorInfo.FromString(detail.value)
            reason, metadata = info.reason, dict(info.metadata)
        elif kind == "google.rpc.BadRequest":
            bad = details_pb2.BadRequest.FromString(detail.value)
            violations += [Violation(its.field, its.description) for its in bad.field_violations]
    return _CLASSES.get(code, UnknownError)(message, reason=reason, metadata=metadata, violations=violations)


def error_of_status(status: status_pb2.Status, prefix: str = "") -> Error:
    """The error that a message tells."""
    return error_of(status.code, prefix + status.message, status.SerializeToString())


def error_of_rpc(failed: grpc.RpcError, address: str) -> Error:
    """The error of a call that failed; one that met no server says where it looked for one."""
    code = failed.code().value[0]
    trailing = failed.trailing_metadata() or ()
    status = next((value for key, value in trailing if key == _STATUS_KEY), b"")
    message = failed.details() or failed.code().name
    if code == 2 and not status and "Stream removed" in message:
        code = 14  # what gRPC says at times of a connection that is lost
    if code == 14 and not status:
        message += f"; is dhpmap-server running at {address}?"
    return error_of(code, message, status)


def bad_argument(field: str, description: str) -> InvalidArgument:
    """A mistake that was found before anything was sent."""
    return InvalidArgument(f"{field}: {description}", violations=[Violation(field, description)])
