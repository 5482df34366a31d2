# SPDX-License-Identifier: BSD-3-Clause
"""Clients of a fleet that note what they were told: a robot that feeds frames, and an editor."""
import threading
import time
import uuid

import grpc
import numpy as np
from dhpmap._camera import Camera
from dhpmap._frames import rgbd_frame
from dhpmap.v1 import edit_service_pb2, edit_service_pb2_grpc, map_service_pb2, map_service_pb2_grpc
from dhpmap.v1 import mapping_service_pb2, mapping_service_pb2_grpc, submap_service_pb2, submap_service_pb2_grpc

MAP, SESSION = "maps/fleet", "robot"
CALL_S = 10  # of one try
# What passes: the same request is sent again.
PASSING = (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.DEADLINE_EXCEEDED, grpc.StatusCode.RESOURCE_EXHAUSTED,
           grpc.StatusCode.CANCELLED, grpc.StatusCode.UNKNOWN, grpc.StatusCode.ABORTED)
CAMERA = Camera(64, 48, 50, 50, 31.5, 23.5)


def connect(address):
    """A channel that tries again soon after its server has gone."""
    return grpc.insecure_channel(address, options=[("grpc.max_reconnect_backoff_ms", 500),
                                                   ("grpc.use_local_subchannel_pool", 1)])


def insist(call, request, for_s=120):
    """The answer, however often it takes to get one."""
    end = time.monotonic() + for_s
    while True:
        try:
            return call(request, timeout=CALL_S)
        except grpc.RpcError as failed:
            if failed.code() not in PASSING or time.monotonic() > end:
                raise
            time.sleep(0.05)


def create_map(address):
    """Also makes the first frames of it, so that there is an object to be edited."""
    with connect(address) as channel:
        insist(map_service_pb2_grpc.MapServiceStub(channel).CreateMap, map_service_pb2.CreateMapRequest(
            map_id=MAP.split("/")[1], label_classes=[{"id": 1, "name": "wall", "kind": "STUFF"}]))


def message_of(sequence):
    """A camera that moves along a wavy wall, so that each frame stores tiles of its own."""
    columns = np.arange(CAMERA.width_px)
    depth = np.tile(1.5 + 0.2 * np.sin(columns / 9 + sequence), (CAMERA.height_px, 1)).astype(np.float32)
    T_map_camera = np.array([[0, 0, 1, 0], [-1, 0, 0, -0.05 * sequence], [0, -1, 0, 1], [0, 0, 0, 1]], float)
    frame = rgbd_frame(CAMERA, depth, None, np.ones(depth.shape, np.uint8), {1: "wall"}, T_map_camera,
                       sequence * 100_000_000, scale_m=None, class_ids={"wall": 1}, persistent_ids=False)
    return mapping_service_pb2.IntegrateFramesRequest(
        sequence=sequence, frame=mapping_service_pb2.Frame.FromString(frame))


class Client:
    """A thread; `error` if it could not go on."""

    def __init__(self, address):
        self.address, self.error = address, None
        self.heard_s = []  # when something was acknowledged as stored
        self._is_ending = threading.Event()
        self._thread = threading.Thread(target=self._guarded, daemon=True)
        self._thread.start()

    def __str__(self):
        return type(self).__name__.lower()

    def last_heard_s(self):
        """Raises what has ended the client."""
        if self.error:
            raise self.error
        return self.heard_s[-1] if self.heard_s else 0

    def end(self):
        self._is_ending.set()
        self._thread.join(180)
        assert not self._thread.is_alive(), "a client does not end"
        if self.error:
            raise self.error

    def _guarded(self):
        try:
            while not self._is_ending.is_set():
                with connect(self.address) as channel:
                    self._work(channel)
        except Exception as error:  # pylint: disable=broad-except
            self.error = error


class Robot(Client):
    """Feeds at a rate; begins again behind what is stored after each lost stream. It goes on while nothing is stored:
    answers to later frames alone tell that it is again."""

    MOST_AHEAD = 1000

    def __init__(self, address, frames_per_s):
        self._period_s = 1 / frames_per_s
        self.stored = 0      # the last sequence that was acknowledged as stored
        self.num_sent = 0
        self.num_streams = 0
        self.refusals = {}
        super().__init__(address)

    def _work(self, channel):
        self.num_streams += 1
        greeted, is_over = threading.Event(), threading.Event()
        stub = mapping_service_pb2_grpc.MappingServiceStub(channel)
        call = stub.IntegrateFrames(self._messages(greeted, is_over))
        try:
            for answer in call:
                if answer.HasField("committed_sequence") and answer.committed_sequence > self.stored:
                    self.stored = answer.committed_sequence
                    self.heard_s.append(time.monotonic())
                greeted.set()
                if answer.outcome == answer.REFUSED:
                    reason = answer.error.message
                    self.refusals[reason] = self.refusals.get(reason, 0) + 1
                    return
        except grpc.RpcError as failed:
            if failed.code() not in PASSING:
                raise
            self._is_ending.wait(0.1)
        finally:
            is_over.set()
            call.cancel()

    def _messages(self, greeted, is_over):
        yield mapping_service_pb2.IntegrateFramesRequest(map=MAP, session=SESSION, take_over=True)
        while not greeted.wait(0.2):
            if is_over.is_set():
                return
        sequence = self.stored
        while not is_over.is_set() and not self._is_ending.is_set():
            if sequence < self.stored + self.MOST_AHEAD:
                sequence += 1
                self.num_sent = max(self.num_sent, sequence)
                yield message_of(sequence)
            self._is_ending.wait(self._period_s)


class Editor(Client):
    """Renames the first object over and over, each request until it is answered; its author names the edit."""

    def __init__(self, address, period_s):
        self._period_s = period_s
        self.told = {}  # author: revision
        super().__init__(address)

    def _work(self, channel):
        submap = self._first_object(channel)
        stub = edit_service_pb2_grpc.EditServiceStub(channel)
        while submap and not self._is_ending.is_set():
            author = f"edit-{len(self.told) + 1}"
            request = edit_service_pb2.ApplyEditsRequest(map=MAP, author=author, request_id=str(uuid.uuid4()), edits=[
                {"submap": submap, "rename": {"display_name": author}}])
            self.told[author] = insist(stub.ApplyEdits, request).revision
            self.heard_s.append(time.monotonic())
            self._is_ending.wait(self._period_s)

    def _first_object(self, channel):
        stub = submap_service_pb2_grpc.SubmapServiceStub(channel)
        found = insist(stub.ListSubmaps, submap_service_pb2.ListSubmapsRequest(parent=MAP)).submaps
        self._is_ending.wait(0.2)
        return next((its.name for its in found if its.instance_id != 0), None)  # 0 holds what is unknown
