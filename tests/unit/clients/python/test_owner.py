# SPDX-License-Identifier: BSD-3-Clause
"""Of several servers on one database: the way to the one that owns a map."""
import grpc
import pytest
from scripted_server import ScriptedServer

import dhpmap
from dhpmap._call import Caller
from dhpmap._owner import OwnerCaller, Owners
from dhpmap.v1 import map_service_pb2 as pb2

MAP = pb2.GetMapResponse(map={"name": "maps/room"}).SerializeToString()
NOT_REACHED = (grpc.StatusCode.UNAVAILABLE, "gone")


def caller_of(address):
    return Caller(grpc.insecure_channel(address), address, 10)


def ask(caller, again=True):
    return caller.raw("MapService/GetMap", b"", again=again)


def find_owner(caller, owners, address):
    """Asks once, and waits until the owner that the answer names is connected."""
    ask(caller)
    while owners.find(address) is None:  # told by gRPC's thread; a second one, of is_ready, may outlive a close
        pass


def test_calls_go_to_the_owner_once_an_answer_has_told_it():
    with ScriptedServer(MAP) as first, ScriptedServer(MAP, MAP) as owner:
        first.owner = owner.owner = owner.address
        owners = Owners(caller_of)
        caller = OwnerCaller(caller_of(first.address), owners)
        find_owner(caller, owners, owner.address)
        assert ask(caller) == ask(caller) == MAP
        assert (len(first.requests), len(owner.requests)) == (1, 2)
        owners.close()


@pytest.mark.parametrize("again, num_asked", [(True, 2), (False, 1)])
def test_an_owner_that_is_gone_is_left(again, num_asked):
    with ScriptedServer(MAP, MAP) as first, ScriptedServer(NOT_REACHED) as owner:
        first.owner = owner.address
        owners = Owners(caller_of)
        caller = OwnerCaller(caller_of(first.address), owners)
        find_owner(caller, owners, owner.address)
        if again:
            assert ask(caller) == MAP
        else:  # it may have been done there
            with pytest.raises(dhpmap.Unavailable):
                ask(caller, again=False)
        assert len(first.requests) == num_asked
        owners.close()


def test_an_owner_that_cannot_be_reached_is_left_alone():
    with ScriptedServer(MAP, MAP, MAP) as first:
        first.owner = "127.0.0.1:1"
        owners = Owners(caller_of)
        caller = OwnerCaller(caller_of(first.address), owners)
        for _ in range(3):
            assert ask(caller) == MAP
        owners.close()


def test_a_key_goes_to_no_other_machine_in_the_clear():
    with ScriptedServer(*[MAP] * 8) as first:
        first.owner = "192.0.2.1:50051"
        with dhpmap.connect(first.address, token="dhp_x") as server:
            assert server["room"].info.name == "room"
            assert server["room"].info.name == "room"
            assert not server._owners._callers
