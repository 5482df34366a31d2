# SPDX-License-Identifier: BSD-3-Clause
"""Frames go in, each once, whatever becomes of the connection or the server."""
import warnings

import numpy as np
import pytest

import dhpmap
from dhpmap import _call
from dhpmap._picture import png_of
from mapped_apartment import camera_of, feed_recording, frames_of, label_set
from scripted_server import Wire

LABELS = [dhpmap.Label(1, "wall", "stuff"), dhpmap.Label(2, "box")]
CAMERA = dhpmap.Camera(64, 48, 40, 40, 32, 24)
T_MAP_CAMERA = np.array([[0, 0, 1, 0], [-1, 0, 0, 0], [0, -1, 0, 1], [0, 0, 0, 1.0]])


def wall(distance_m=2.0):
    """A camera looks at a wall, with a box before it."""
    depth, labels = np.full((48, 64), distance_m, np.float32), np.ones((48, 64), np.uint8)
    depth[16:32, 24:40], labels[16:32, 24:40] = distance_m - 0.5, 2
    return depth, np.full((48, 64, 3), 128, np.uint8), labels, {1: "wall", 2: "box"}


@pytest.fixture
def empty(connection):
    made = connection.create("empty", LABELS)
    yield made
    connection.delete("empty")


def feed_walls(feed, first, count):
    for stamp in range(first, first + count):
        feed.rgbd(*wall(), T_MAP_CAMERA, stamp)


def test_what_was_fed_is_stored_when_the_block_is_left(empty):
    with empty.feed("robot1", camera=CAMERA) as feed:
        feed_walls(feed, 1, 12)
    assert (feed.num_sent, feed.num_fused, feed.stored_sequence, feed.num_refused) == (12, 12, 12, 0)
    assert empty.info.num_frames == 12 and [its.name for its in empty.sessions()] == ["robot1"]
    assert {its.class_name for its in empty.objects} == {"", "wall", "box"}
    assert empty.points((1.5, 0, 1)).object_id == empty.find("box")[0].id


def test_a_session_goes_on_where_it_was(empty):
    with empty.feed("robot1", camera=CAMERA) as feed:
        feed_walls(feed, 1, 3)
    with empty.feed("robot1", camera=CAMERA) as feed:
        assert feed.rgbd(*wall(), T_MAP_CAMERA, 4) == 4
    assert empty.info.num_frames == 4


def test_16_bit_depth_is_metres_times_its_scale(empty):
    depth, rgb, labels, segments = wall()
    with empty.feed("robot1", camera=CAMERA, depth_scale_m=0.001) as feed:
        for stamp in range(1, 5):
            feed.rgbd((depth * 1000).astype(np.uint16), rgb, labels, segments, T_MAP_CAMERA, stamp)
    assert empty.points((2, 0.5, 1)).object_id == empty.find("wall")[0].id


def test_a_matrix_is_a_camera_for_images_as_large_as_the_first(empty):
    with empty.feed("robot1", camera=[[40, 0, 32], [0, 40, 24], [0, 0, 1]]) as feed:
        feed_walls(feed, 1, 1)
        with pytest.raises(dhpmap.InvalidArgument, match=r"wanted \(height, width\) = \(48, 64\)"):
            feed.rgbd(np.ones((24, 32), np.float32), T_map_camera=T_MAP_CAMERA, stamp_ns=2)
    assert feed.num_fused == 1


def test_a_bad_frame_is_told_before_it_is_sent_and_the_feed_goes_on(empty):
    with empty.feed("robot1", camera=CAMERA) as feed:
        feed_walls(feed, 1, 2)
        with pytest.raises(dhpmap.InvalidArgument, match="stamp_ns"):
            feed_walls(feed, 1, 1)
        with pytest.raises(dhpmap.InvalidArgument, match="left-handed"):
            feed.rgbd(*wall(), np.diag((1, 1, -1, 1.0)), 3)
        with pytest.raises(dhpmap.InvalidArgument, match="labels and segments come together"):
            feed.rgbd(wall()[0], labels=wall()[2], T_map_camera=T_MAP_CAMERA, stamp_ns=3)
        feed_walls(feed, 3, 1)
    assert feed.num_fused == 3


def test_what_the_server_doubts_is_a_warning_once(empty):
    with pytest.warns(dhpmap.FrameWarning) as told:
        with empty.feed("robot1", camera=CAMERA) as feed:
            feed_walls(feed, 1, 10)
            for stamp in range(11, 16):  # nothing is in range any more
                feed.rgbd(np.full((48, 64), 150, np.float32), T_map_camera=T_MAP_CAMERA, stamp_ns=stamp)
    assert feed.num_fused == 15 and len(told) == 1 and "DEPTH_IN_MILLIMETRES" in str(told[0].message)


def test_ids_that_no_segment_has_are_a_warning_once(empty):
    depth, rgb, labels, _ = wall()
    with pytest.warns(dhpmap.FrameWarning, match="segments lacks, 2: ") as told:
        with empty.feed("robot1", camera=CAMERA) as feed:
            for stamp in range(1, 4):
                feed.rgbd(depth, rgb, labels, iter([dhpmap.Segment(1, "wall")]), T_MAP_CAMERA, stamp)
    assert len(told) == 1 and feed.num_fused == 3


def test_scans_of_a_lidar_go_in(empty):
    y, z = np.meshgrid(np.linspace(-1, 1, 60), np.linspace(-0.5, 0.5, 30))
    points = np.stack([np.full_like(y, 2), y, z], axis=-1).reshape(-1, 3)
    with empty.feed("robot1") as feed:
        for stamp in range(1, 4):
            feed.lidar(points, dhpmap.pose(0, 0, 1), stamp, segment_ids=np.ones(len(points), int), segments={1: "wall"})
        with pytest.raises(dhpmap.InvalidArgument, match="camera"):
            feed_walls(feed, 5, 1)
    assert empty.points((2, 0, 1)).near_surface and feed.num_fused == 3


def test_points_of_a_scan_take_what_an_image_beside_it_shows(empty):
    y, z = np.meshgrid(np.linspace(-0.9, 0.9, 91), np.linspace(-0.5, 0.5, 51))
    points = np.stack([np.full_like(y, 2), y, z], axis=-1).reshape(-1, 3)
    P = [[32, -40, 0, 0], [24, 0, -40, 0], [1, 0, 0, 0]]  # looks along x, y to the left, z up
    labels = np.ones((48, 64), np.uint8)
    labels[:, 32:] = 2  # what is to the right
    image = dhpmap.LidarImage(P, labels=labels)
    with empty.feed("robot1") as feed:
        for stamp in range(1, 5):
            feed.lidar(points, dhpmap.pose(0, 0, 1), stamp, segments={1: "wall", 2: "box"}, image=image)
        with pytest.raises(dhpmap.InvalidArgument, match="segments come with"):
            feed.lidar(points, np.eye(4), 9, segment_ids=np.ones(len(points), int), segments={1: "wall"}, image=image)
        with pytest.raises(dhpmap.InvalidArgument, match="neither rgb nor labels"):
            feed.lidar(points, np.eye(4), 9, image=dhpmap.LidarImage(P))
    owners = empty.points([(2, 0.4, 1), (2, -0.4, 1)]).object_id
    assert owners.tolist() == [empty.find("wall")[0].id, empty.find("box")[0].id]


def test_the_image_beside_a_scan_may_be_a_file(empty):
    P = [[32, -40, 0, 0], [24, 0, -40, 0], [1, 0, 0, 0]]
    y, z = np.meshgrid(np.arange(-1, 1, 0.02), np.arange(-0.5, 0.5, 0.02))
    points = np.stack([np.full(y.size, 2.0), y.ravel(), z.ravel()], axis=-1)
    red = png_of(np.full((48, 64, 3), (200, 10, 20), np.uint8))
    with empty.feed("robot1") as feed:
        for stamp in range(1, 5):
            feed.lidar(points, dhpmap.pose(0, 0, 1), stamp, image=dhpmap.LidarImage(P, rgb=red, shape=(48, 64)))
        with pytest.raises(dhpmap.InvalidArgument, match="has a file for rgb, and no shape"):
            feed.lidar(points, np.eye(4), 9, image=dhpmap.LidarImage(P, rgb=red))
    assert np.abs(empty.points([(2, 0.4, 1)]).rgb[0].astype(int) - (200, 10, 20)).max() <= 1


def test_who_takes_the_session_over_ends_it_for_the_other(empty):
    feed = empty.feed("robot1", camera=CAMERA)
    with empty.feed("robot1", camera=CAMERA) as other:
        feed_walls(other, 2, 1)
    with pytest.raises(dhpmap.Aborted, match="FEED_TAKEN_OVER"):
        feed.close()


def test_a_cut_connection_costs_no_frame_and_doubles_none(server, empty, monkeypatch):
    monkeypatch.setattr(_call, "FIRST_PAUSE_S", 0.001)
    with Wire(server.address) as wire, dhpmap.connect(wire.address) as connection:
        with connection["empty"].feed("robot1", camera=CAMERA) as feed:
            for first in (1, 21, 41):
                feed_walls(feed, first, 20)
                wire.cut()
                wire.mend()
        assert wire.num_connections >= 3
    assert empty.info.num_frames == 60 and empty.sessions()[0].stored_sequence == 60


@pytest.mark.parametrize("ends", ["kill", "stop"])
def test_a_server_that_ends_costs_no_frame(own_server, recording, monkeypatch, ends):
    monkeypatch.setattr(_call, "FIRST_PAUSE_S", 0.001)
    with dhpmap.connect(own_server.address) as connection:
        made = connection.create("room", label_set(recording))
        with made.feed("robot1", camera=camera_of(recording), persistent_ids=True) as feed:
            for number, frame in enumerate(frames_of(recording)):
                feed.rgbd(*frame)
                if number in (10, 25):
                    getattr(own_server, ends)()
                    own_server.start_again()
        assert made.info.num_frames == 60 and feed.stored_sequence == 60


def test_what_is_kept_of_frames_has_a_bound(empty):
    depth, rgb, labels, segments = wall()
    with empty.feed("robot1", camera=CAMERA, memory_mib=1) as feed:
        for stamp in range(1, 120):  # of 27 kB each
            feed.rgbd(depth, rgb, labels, segments, T_MAP_CAMERA, stamp)
            assert feed._stream._kept_bytes <= 1 << 20
    assert feed.stored_sequence == 119


def test_a_map_that_is_not_there_cannot_be_fed(connection, empty):
    gone = connection.create("gone", LABELS)
    connection.delete("gone")
    with pytest.raises(dhpmap.NotFound):
        gone.feed("robot1")


def test_frames_with_the_truth_make_the_rooms_objects(apartment):
    assert apartment.info.num_frames == 60
    assert {"sofa", "chair", "floor"} <= {its.class_name for its in apartment.objects}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert apartment.sessions()[0].stored_sequence == 60


def test_a_feed_that_is_closed_takes_no_frame(empty):
    feed = empty.feed("robot1", camera=CAMERA)
    feed.close()
    with pytest.raises(dhpmap.FailedPrecondition, match="closed"):
        feed_walls(feed, 1, 1)
