# SPDX-License-Identifier: BSD-3-Clause
"""Asks a server what is stored."""
from dhpmap.v1 import edit_service_pb2, edit_service_pb2_grpc, map_service_pb2, map_service_pb2_grpc
from dhpmap.v1 import mapping_service_pb2, mapping_service_pb2_grpc

from robot import MAP, SESSION, connect, insist
from verdict import Stored


def stored_edits(channel):
    stub = edit_service_pb2_grpc.EditServiceStub(channel)
    token, edits = "", []
    while True:
        page = insist(stub.ListEdits, edit_service_pb2.ListEditsRequest(parent=MAP, page_token=token))
        edits += [(its.author, its.revision) for its in page.edits]
        token = page.next_page_token
        if not token:
            return edits


def read(address):
    with connect(address) as channel:
        the_map = insist(map_service_pb2_grpc.MapServiceStub(channel).GetMap,
                         map_service_pb2.GetMapRequest(name=MAP)).map
        sessions = insist(mapping_service_pb2_grpc.MappingServiceStub(channel).ListSessions,
                          mapping_service_pb2.ListSessionsRequest(parent=MAP)).sessions
        stored = next((its.committed_sequence for its in sessions if its.session == SESSION), 0)
        return Stored(the_map.num_frames, stored, stored_edits(channel))
