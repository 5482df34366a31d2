# SPDX-License-Identifier: BSD-3-Clause
"""Deadlines, retries and errors, against a server that answers as it is told."""
import asyncio
import concurrent.futures

import grpc
import numpy as np
import pytest

import dhpmap
from dhpmap import _call, _columns
from dhpmap.v1 import (edit_service_pb2, map_service_pb2, query_options_pb2, query_service_pb2, rpc_error_details_pb2,
                       rpc_status_pb2)
from mapped_apartment import feed_recording, label_set
from scripted_server import ScriptedServer, Wire

MAP = map_service_pb2.GetMapResponse(map={"name": "maps/a"}).SerializeToString()
LOST = (grpc.StatusCode.UNAVAILABLE, "gone for a moment")


@pytest.fixture(autouse=True)
def short_pauses(monkeypatch):
    monkeypatch.setattr(_call, "FIRST_PAUSE_S", 0.001)


def distance_answer(revision):
    packed = {"distance_m": [0.5], "gradient": [1, 0, 0], "nearest_point_m": [1, 2, 3], "instance_id": [-1],
              "class_id": [-1], "status": [2]}
    return query_service_pb2.QueryDistancesResponse(revision=revision, packed=packed).SerializeToString()


def test_points_that_take_several_calls_are_all_asked_of_the_first_ones_revision(monkeypatch):
    monkeypatch.setattr(_columns, "MOST_ROWS_A_CALL", 1)
    answers = [distance_answer(7) for _ in range(3)]
    with ScriptedServer(MAP, *answers) as server, dhpmap.connect(server.address) as connection:
        assert connection["a"].distances(np.zeros((3, 3))).revision == 7
    requests = [query_service_pb2.QueryDistancesRequest.FromString(request) for _, request in server.requests[1:]]
    assert [its.read_revision for its in requests] == [0, 7, 7]


def test_an_eventual_map_asks_for_any_state_and_the_rest_of_a_query_for_that_one(monkeypatch):
    monkeypatch.setattr(_columns, "MOST_ROWS_A_CALL", 1)
    answers = [distance_answer(7) for _ in range(2)]
    with ScriptedServer(MAP, *answers) as server, dhpmap.connect(server.address) as connection:
        assert connection["a"].eventual().distances(np.zeros((2, 3))).revision == 7
    requests = [query_service_pb2.QueryDistancesRequest.FromString(request) for _, request in server.requests[1:]]
    eventual = query_options_pb2.Consistency.EVENTUAL
    assert [(its.consistency, its.read_revision) for its in requests] == [(eventual, 0), (eventual, 7)]
    assert all(its.map == "maps/a" for its in requests)


def test_a_query_whose_answer_is_lost_is_asked_again():
    with ScriptedServer(MAP, LOST, LOST, distance_answer(7)) as server, dhpmap.connect(server.address) as connection:
        d = connection["a"].distances((1, 2, 3))
    assert d.revision == 7 and d.distance_m == 0.5 and d.object_id == -1 and d.clamped
    assert len({request for _, request in server.requests[1:]}) == 1


@pytest.mark.parametrize("asks", ["call", "loop"])
def test_who_has_met_no_server_is_answered_as_soon_as_it_is_back(asks, server):
    with Wire(server.address) as wire, dhpmap.connect(wire.address) as other:
        target = other["apartment"]
        source = target.loop() if asks == "loop" else target
        assert source.distances((2, 2, 1)).revision > 0
        wire.cut()
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            asked = pool.submit(source.distances, (2, 2, 1), deadline_s=4)  # gRPC looks at idle channels every 5 s
            assert wire.has_refused.wait(60)
            wire.mend()
            assert asked.result().revision > 0


def test_who_meets_no_server_until_the_deadline_is_told_so(server):
    with Wire(server.address) as wire, dhpmap.connect(wire.address) as other:
        target = other["apartment"]
        wire.cut()
        with pytest.raises(dhpmap.Unavailable, match="is dhpmap-server running at 127.0.0.1"):
            target.distances((1, 2, 3), deadline_s=0.5)


def test_an_edit_that_is_sent_again_keeps_its_request_id():
    done = edit_service_pb2.ApplyEditsResponse(revision=8, results=[{}]).SerializeToString()
    with ScriptedServer(MAP, LOST, done) as server, dhpmap.connect(server.address, author="anna") as connection:
        with connection["a"].edit() as e:
            e.delete(3)
    requests = [edit_service_pb2.ApplyEditsRequest.FromString(request) for _, request in server.requests[1:]]
    assert len(requests) == 2 and requests[0] == requests[1] and len(requests[0].request_id) == 36
    assert requests[0].author == "anna" and requests[0].edits[0].submap == "maps/a/submaps/3" and e.revision == 8


def test_making_a_map_is_never_sent_twice():
    with ScriptedServer(LOST) as server, dhpmap.connect(server.address) as connection:
        with pytest.raises(dhpmap.Unavailable, match="gone for a moment"):
            connection.create("a")
    assert len(server.requests) == 1


def test_retries_end_by_the_deadline_with_what_went_wrong():
    with ScriptedServer(MAP, *[LOST] * 1000) as server, dhpmap.connect(server.address) as connection:
        with pytest.raises(dhpmap.Unavailable, match="is dhpmap-server running at 127.0.0.1"):
            connection["a"].distances((1, 2, 3), deadline_s=1)
    assert len(server.requests) > 2


def test_every_call_has_a_deadline():
    with ScriptedServer(MAP, MAP) as server, dhpmap.connect(server.address, deadline_s=9) as connection:
        connection["a"].info
    assert all(5 < left_s <= 9.5 for left_s in server.deadlines_s)


def test_a_token_goes_with_every_call_and_not_in_the_clear_to_others():
    with ScriptedServer(MAP) as server, dhpmap.connect(server.address, token="secret") as connection:
        connection["a"]
    assert server.metadata[0]["authorization"] == "Bearer secret"
    for other in ("robot.example:50051", "[::ffff:10.0.0.5]:50051"):
        with pytest.raises(dhpmap.InvalidArgument, match="in the clear"):
            dhpmap.connect(other, token="secret")


def test_a_token_is_read_from_a_file_that_its_owner_alone_may_read(tmp_path):
    file = tmp_path / "key"
    file.write_text(" secret\n")
    file.chmod(0o640)
    with pytest.raises(dhpmap.InvalidArgument, match="chmod 600"):
        dhpmap.connect("127.0.0.1:1", token_file=file)
    file.chmod(0o600)
    with ScriptedServer(MAP) as server, dhpmap.connect(server.address, token_file=file) as connection:
        connection["a"]
    assert server.metadata[0]["authorization"] == "Bearer secret"
    with pytest.raises(dhpmap.InvalidArgument, match="not both"):
        dhpmap.connect("127.0.0.1:1", token_file=file, token="x")
    file.write_text("two words")
    with pytest.raises(dhpmap.InvalidArgument, match="no key"):
        dhpmap.connect("127.0.0.1:1", token_file=file)


def test_no_server_is_told_with_where_it_was_looked_for():
    with pytest.raises(dhpmap.Unavailable, match="no server answers at 127.0.0.1:1 "):
        dhpmap.connect("127.0.0.1:1", connect_s=0.2)


def test_who_calls_at_the_rest_door_is_told_so(server):
    with pytest.raises(dhpmap.Unavailable, match="an HTTP server is there, such as the REST door"):
        dhpmap.connect(server.http_address, connect_s=0.2)


@pytest.mark.parametrize("code, kind, base", [
    ("INVALID_ARGUMENT", dhpmap.InvalidArgument, ValueError), ("NOT_FOUND", dhpmap.NotFound, LookupError),
    ("ALREADY_EXISTS", dhpmap.AlreadyExists, dhpmap.Error), ("ABORTED", dhpmap.Aborted, dhpmap.Error),
    ("FAILED_PRECONDITION", dhpmap.FailedPrecondition, dhpmap.Error), ("OUT_OF_RANGE", dhpmap.OutOfRange, dhpmap.Error),
    ("RESOURCE_EXHAUSTED", dhpmap.ResourceExhausted, dhpmap.Error), ("DATA_LOSS", dhpmap.DataLoss, dhpmap.Error),
    ("PERMISSION_DENIED", dhpmap.PermissionDenied, dhpmap.Error), ("INTERNAL", dhpmap.Internal, dhpmap.Error),
    ("UNAUTHENTICATED", dhpmap.Unauthenticated, dhpmap.Error), ("UNIMPLEMENTED", dhpmap.Unimplemented, dhpmap.Error),
    ("DEADLINE_EXCEEDED", dhpmap.DeadlineExceeded, TimeoutError), ("UNKNOWN", dhpmap.UnknownError, dhpmap.Error)])
def test_each_status_is_an_exception_of_its_own(code, kind, base):
    with ScriptedServer((grpc.StatusCode[code], "so it is")) as server, dhpmap.connect(server.address) as connection:
        with pytest.raises(kind, match="so it is|took longer than") as caught:
            connection.delete("a")
    assert isinstance(caught.value, base) and isinstance(caught.value, dhpmap.Error)


def test_an_error_has_reason_metadata_and_violations(apartment):
    with pytest.raises(dhpmap.InvalidArgument, match="there is no class 'soffa'; did you mean 'sofa'") as caught:
        apartment.find("soffa")
    assert caught.value.violations[0].field.startswith("options.class_names") and caught.value.reason == "BAD_FILTER"
    with pytest.raises(dhpmap.NotFound, match="MAP_NOT_FOUND"):
        apartment.at(1)._caller.unary("MapService/GetMap", map_service_pb2.GetMapRequest(name="maps/none"),
                                      map_service_pb2.GetMapResponse)


def test_details_of_an_error_are_read_as_the_server_packs_them():
    from dhpmap._errors import error_of
    info = rpc_error_details_pb2.ErrorInfo(reason="MERGED_INTO", metadata={"merged_into": "maps/a/submaps/3"})
    status = rpc_status_pb2.Status(code=5)
    status.details.add(type_url="type.googleapis.com/google.rpc.ErrorInfo", value=info.SerializeToString())
    error = error_of(5, "it is a part of another", status.SerializeToString())
    assert (error.reason, error.metadata) == ("MERGED_INTO", {"merged_into": "maps/a/submaps/3"})
    assert str(error) == "it is a part of another [MERGED_INTO]"


def test_a_map_that_is_not_there_is_told_with_those_that_are(connection):
    with pytest.raises(dhpmap.NotFound, match="the server's maps: apartment"):
        connection["appartment"]


def test_calls_of_several_threads_and_of_asyncio_do_not_mix(apartment):
    points = [(1 + 0.1 * i, 2, 0.5) for i in range(40)]
    one_by_one = [apartment.distances(point).distance_m.item() for point in points]

    async def at_once():
        return await asyncio.gather(*(asyncio.to_thread(apartment.distances, point) for point in points))

    assert [d.distance_m.item() for d in asyncio.run(at_once())] == one_by_one


@pytest.mark.parametrize("ends", ["kill", "stop"])
def test_a_loop_goes_on_after_the_server_was_restarted(own_server, recording, ends):
    with dhpmap.connect(own_server.address) as connection:
        made = connection.create("room", label_set(recording))
        feed_recording(made, recording)
        with made.loop() as loop:
            revision = loop.distances([[0, 0, 1]]).revision
            getattr(own_server, ends)()
            own_server.start_again()
            assert loop.distances([[0, 0, 1]]).revision >= revision


def test_a_loop_whose_pinned_state_is_gone_says_so_until_it_is_unpinned(own_server, recording):
    with dhpmap.connect(own_server.address) as connection:
        made = connection.create("room", label_set(recording))
        feed_recording(made, recording)
        with made.loop() as loop:
            loop.pin()
            feed_recording(made, recording, "robot2")  # so that the pinned revision is a past one
            own_server.stop()
            own_server.start_again()
            for _ in range(2):
                with pytest.raises(dhpmap.Error, match="REVISION_NOT_KEPT"):
                    loop.distances([[0, 0, 1]])
            loop.unpin()
            assert loop.distances([[0, 0, 1]]).revision > 0
