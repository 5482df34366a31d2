# SPDX-License-Identifier: BSD-3-Clause
"""Maps of objects for robots: ask, edit, watch and feed a dhpmap-server.

    import dhpmap
    m = dhpmap.connect("localhost:50051")["apartment"]
    chair = m.find("chair", near=(2, 2, 0))[0]
    d = m.distances([(2, 2, 0.5)], ignore=[chair])

Lengths are metres, angles radians, stamps nanoseconds of the sensor's clock; T_a_b takes points of frame b to frame a.
Arrays go in as anything that numpy takes, and come out as numpy arrays. Errors are all dhpmap.Error.
"""
import importlib.util

if importlib.util.find_spec("dhpmap.v1") is None:
    raise ImportError("dhpmap.v1 is not made yet: build the target python_client, "
                      "or run clients/python/generate_stubs.py")

# The rest, in the order of the modules.
from dhpmap._camera import Camera
from dhpmap._connect import Server, connect
from dhpmap._contacts import BodyCheck, Collisions, Contact
from dhpmap._distances import Distances
from dhpmap._edit import Edit, EditResult, New, Plane
from dhpmap._errors import (Aborted, AlreadyExists, Cancelled, DataLoss, DeadlineExceeded, Error, FailedPrecondition,
                            Internal, InvalidArgument, NotFound, OutOfRange, PermissionDenied, ResourceExhausted,
                            Unauthenticated, Unavailable, Unimplemented, UnknownError, Violation)
from dhpmap._feed import Feed, FrameWarning
from dhpmap._frames import LidarImage, Segment
from dhpmap._geometry import Mesh, Voxels
from dhpmap._grids import DistanceGrid, Slice
from dhpmap._history import LoggedEdit, Undone
from dhpmap._label_sets import label_set, label_sets
from dhpmap._loop import Loop
from dhpmap._map import Map
from dhpmap._map_info import Finished, Label, MapInfo, MapStats, Revision, Session, Verified
from dhpmap._map_view import EventualMap, PastMap
from dhpmap._objects import Object, Ref
from dhpmap._options import QueryOptions
from dhpmap._points import Points, Rays
from dhpmap._pose import pose
from dhpmap._robot import Clearance, PathCheck, PathContact, Spheres
from dhpmap._search import Objects, Relation
from dhpmap._shapes import Box, Capsule, OrientedBox, Sphere
from dhpmap._watch import Change, Watch

__version__ = "0.2.0"

__all__ = [
    "Aborted", "AlreadyExists", "BodyCheck", "Box", "Camera", "Cancelled", "Capsule", "Change", "Clearance",
    "Collisions", "Contact", "DataLoss", "DeadlineExceeded", "DistanceGrid", "Distances", "Edit", "EditResult",
    "Error", "EventualMap", "FailedPrecondition", "Feed", "Finished", "FrameWarning", "Internal", "InvalidArgument",
    "Label", "LidarImage", "LoggedEdit", "Loop", "Map", "MapInfo", "MapStats", "Mesh", "New", "NotFound", "Object",
    "Objects", "OrientedBox", "OutOfRange", "PastMap", "PathCheck", "PathContact", "PermissionDenied", "Plane",
    "Points", "QueryOptions", "Rays", "Ref", "Relation", "ResourceExhausted", "Revision", "Segment", "Server",
    "Session", "Slice", "Sphere", "Spheres", "Unauthenticated", "Unavailable", "Undone", "Unimplemented",
    "UnknownError", "Verified", "Violation", "Voxels", "Watch", "connect", "label_set", "label_sets", "pose",
]
