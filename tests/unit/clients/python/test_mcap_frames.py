# SPDX-License-Identifier: BSD-3-Clause
"""Frames of small recordings that are made here: topics, stamps, poses, encodings, and what is wrong with them."""
import struct
import tracemalloc
import warnings

import numpy as np
import pytest

import dhpmap
import mcap_bytes as made
from dhpmap.mcap import Gap, McapWarning, frames

IMAGE, INFO, TF = "sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo", "tf2_msgs/msg/TFMessage"
STILL = ((0, 0, 0), (0, 0, 0, 1))
DEPTH = [struct.pack("<4H", *row) for row in ((1000, 0, 2000, 3000), (1, 2, 3, 4), (5, 6, 7, 65535))]
MS = 1_000_000


def rows(dtype, values, padding=0):
    return [np.asarray(row, dtype).tobytes() + bytes(padding) for row in values]


def recorded(tmp_path, *more, stamps_ms=(100, 200, 300), moving_ms=range(0, 401, 50), depth=("16UC1", DEPTH),
             info=None, frame_id="camera"):
    """Depth at some stamps, the robot 1 m further along x each second; and messages: topic, type, stamp in ms, data."""
    its = [("/tf_static", TF, 0, made.transforms((0, "base", "camera", (0, 0, 1), (0, 0, 0, 1))))]
    its += [("/tf", TF, ms, made.transforms((ms * MS, "map", "base", (ms / 1000, 0, 0), (0, 0, 0, 1))))
            for ms in moving_ms]
    its += [("/cam/camera_info", INFO, ms, info or made.camera_info(ms * MS, 4, 3)) for ms in stamps_ms]
    its += [("/cam/depth", IMAGE, ms, made.image(ms * MS, depth[0], depth[1], 4, frame_id)) for ms in stamps_ms]
    recording = made.Recording()
    for topic, kind, ms, data in sorted([*its, *more], key=lambda one: one[2]):
        recording.add(topic, kind, data, ms * MS)
    return recording.write(tmp_path / "its.mcap")


def color(ms, encoding="rgb8", pixels=None, width=4, frame_id="camera", topic="/cam/color"):
    pixels = rows("u1", np.arange(36).reshape(3, 12)) if pixels is None else pixels
    return topic, IMAGE, ms, made.image(ms * MS, encoding, pixels, width, frame_id)


def test_a_pose_between_two_transforms_is_interpolated(tmp_path):
    got = list(frames(recorded(tmp_path, stamps_ms=(110, 225))))
    assert [its.T_map_camera[:3, 3].round(9).tolist() for its in got] == [[0.11, 0, 1], [0.225, 0, 1]]
    assert got[0].depth.tolist() == [[1000, 0, 2000, 3000], [1, 2, 3, 4], [5, 6, 7, 65535]]


def test_rotations_turn_at_constant_speed_whatever_the_sign_of_their_quaternions(tmp_path):
    half = np.sqrt(0.5)
    turns = [("/tf", TF, ms, made.transforms((ms * MS, "/map", "/base", (0, 0, 0), xyzw)))
             for ms, xyzw in ((0, (0, 0, 0, 1)), (300, (0, 0, -half, -half)))]
    (got,) = frames(recorded(tmp_path, *turns, stamps_ms=(100,), moving_ms=(), frame_id="/camera"))
    c, s = np.cos(np.pi / 6), 0.5  # a third of a quarter turn to the left
    assert np.allclose(got.T_map_camera, [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]], atol=1e-9)


def test_the_map_may_lie_below_a_common_ancestor(tmp_path):
    links = made.transforms((0, "earth", "floor_plan", (10, 0, 0), (0, 0, 1, 0)),
                            (0, "earth", "map", (0, 2, 0), (0, 0, 0, 1)))
    (got,) = frames(recorded(tmp_path, ("/tf_static", TF, 0, links), stamps_ms=(100,)), map_frame="floor_plan")
    assert np.allclose(got.T_map_camera[:3], [[-1, 0, 0, 9.9], [0, -1, 0, -2], [0, 0, 1, 1]])


def test_frames_before_the_first_transform_and_after_the_last_are_left_out(tmp_path):
    path = recorded(tmp_path, stamps_ms=(20, 100, 200, 390), moving_ms=range(50, 301, 50))
    with pytest.warns(McapWarning, match="of 4 frames, 0 were left out .* 2 for want of a transform"):
        its = frames(path)
        assert [one.stamp_ns // MS for one in its] == [100, 200]
    assert its.num_without_pose == 2 and its.num_expected == 4


def test_a_gap_in_the_transforms_is_an_error_that_may_be_skipped(tmp_path):
    path = recorded(tmp_path, stamps_ms=(100, 500, 900), moving_ms=(50, 100, 850, 900))
    with pytest.raises(Gap, match="to 'map' has a gap of 0.750 s around stamp 500000000.*skip_gaps=True") as told:
        list(frames(path))
    assert told.value.reason == "NO_TRANSFORM" and isinstance(told.value, dhpmap.OutOfRange)
    with pytest.warns(McapWarning, match="1 for want of a transform"):
        assert len(list(frames(path, skip_gaps=True))) == 2
    assert len(list(frames(path, max_gap_s=1))) == 3


def test_transforms_that_stop_for_long_are_a_gap_before_the_recording_ends(tmp_path):
    path = recorded(tmp_path, stamps_ms=(100, 300, 4000), moving_ms=(50, 200))
    with pytest.raises(Gap, match="ends 0.100 s before stamp 300000000"):
        list(frames(path))


def test_a_recording_without_the_map_s_frame_says_which_ones_there_are(tmp_path):
    with pytest.raises(Gap, match="no transforms lead from 'camera' to 'world'.*names: base, camera, map"):
        list(frames(recorded(tmp_path), map_frame="world"))


@pytest.mark.parametrize("link, message", [
    ((0, "map", "base", (0, 0, 0), (0, 0, 0, 0)), "is none: quaternion"),
    ((0, "map", "base", (np.nan, 0, 0), (0, 0, 0, 1)), "is none"),
    ((0, "camera", "map", (0, 0, 0), (0, 0, 0, 1)), "go in a circle")],
    ids=("no_rotation", "not_finite", "circle"))
def test_transforms_that_cannot_be_are_refused(tmp_path, link, message):
    with pytest.raises(dhpmap.DataLoss, match=message):
        list(frames(recorded(tmp_path, ("/tf", TF, 60, made.transforms(link)))))


def test_images_go_with_the_nearest_depth_within_the_tolerance(tmp_path):
    others = [color(ms, pixels=rows("u1", np.full((3, 12), ms // 10))) for ms in (85, 95, 104, 190, 250, 301)]
    path = recorded(tmp_path, *others)
    with pytest.warns(McapWarning, match="of 3 frames, 1 were left out for want of an image"):
        got = {its.stamp_ns // MS: its.rgb[0, 0, 0] for its in frames(path, tolerance_s=0.008)}
    assert got == {100: 10, 300: 30}
    assert len(list(frames(path))) == 3 and len(list(frames(path, color=""))) == 3


def test_a_recording_is_never_held_as_a_whole(tmp_path):
    large = [bytes(160_000)] * 3  # rows with much padding
    path = recorded(tmp_path, stamps_ms=range(0, 4000, 100), moving_ms=range(0, 4001, 100), depth=("16UC1", large))
    assert path.stat().st_size > 19_000_000
    tracemalloc.start()
    assert sum(1 for _ in frames(path)) == 40
    most_bytes = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most_bytes < 4_000_000


def test_what_comes_late_is_waited_for(tmp_path):
    late = [("/cam/color", IMAGE, 1900 + ms, color(ms)[3]) for ms in (100, 200, 300)]
    assert [its.stamp_ns // MS for its in frames(recorded(tmp_path, *late))] == [100, 200, 300]


@pytest.mark.parametrize("encoding, pixel, rgb", [
    ("rgb8", (1, 2, 3), (1, 2, 3)), ("bgr8", (1, 2, 3), (3, 2, 1)), ("rgba8", (1, 2, 3, 4), (1, 2, 3)),
    ("bgra8", (1, 2, 3, 4), (3, 2, 1)), ("mono8", (7,), (7, 7, 7))], ids=("rgb", "bgr", "rgba", "bgra", "mono"))
def test_colours_of_all_encodings_with_padded_rows(tmp_path, encoding, pixel, rgb):
    pixels = rows("u1", [pixel * 4] * 3, padding=5)
    (got,) = frames(recorded(tmp_path, color(100, encoding, pixels), stamps_ms=(100,)))
    assert got.rgb.dtype == np.uint8 and got.rgb.shape == (3, 4, 3) and (got.rgb == rgb).all()


def test_depth_in_metres_and_of_the_other_byte_order(tmp_path):
    metres = [[1.5, np.nan, np.inf, 0], [1, 2, 3, 4], [5, 6, 7, 8]]
    (got,) = frames(recorded(tmp_path, stamps_ms=(100,), depth=("32FC1", rows("<f4", metres))))
    assert got.depth_scale_m is None and got.depth.dtype == np.float32
    assert got.depth.tolist() == [[1.5, 0, 0, 0], *metres[1:]]
    big = made.image(100 * MS, "16UC1", rows(">u2", [[1000, 2, 3, 4]] * 3), 4, order=">", is_bigendian=1)
    (got,) = frames(recorded(tmp_path, ("/big/depth", IMAGE, 100, big), stamps_ms=(100,)), depth="/big/depth",
                    camera_info="/cam/camera_info")
    assert got.depth[0].tolist() == [1000, 2, 3, 4]


@pytest.mark.parametrize("depth, message", [
    (("8UC1", rows("u1", np.ones((3, 4)))), r"/cam/depth is of '8UC1'; depth is 16UC1 \(millimetres\) or 32FC1"),
    (("16UC1", rows("u1", np.ones((3, 7)))), "/cam/depth has a damaged image: 4 x 3 of 16UC1 in rows of 7 bytes")],
    ids=("encoding", "rows"))
def test_depth_that_is_none_is_told(tmp_path, depth, message):
    with pytest.raises(dhpmap.Error, match=message):
        list(frames(recorded(tmp_path, depth=depth)))


@pytest.mark.parametrize("options, message", [
    ({"d": (0.1, 0, 0, 0, 0)}, "the camera distorts .*rectified=True"), ({"binning": 2}, "binned or cropped"),
    ({"K": (0,) * 9}, "not calibrated")], ids=("distorts", "binned", "no_calibration"))
def test_cameras_that_are_no_pinholes_are_told(tmp_path, options, message):
    info = made.camera_info(0, 4, 3, **options)
    with pytest.raises(dhpmap.InvalidArgument, match=f"/cam/camera_info: .*{message}"):
        frames(recorded(tmp_path, info=info))


def test_of_rectified_images_the_projection_holds(tmp_path):
    path = recorded(tmp_path, info=made.camera_info(0, 4, 3, d=(0.1, 0, 0, 0, 0)))
    assert next(iter(frames(path, rectified=True))).camera == dhpmap.Camera(4, 3, 40, 40, 2, 1.5)


def test_a_camera_that_changes_is_refused(tmp_path):
    other = ("/cam/camera_info", INFO, 250, made.camera_info(250 * MS, 4, 3, K=(60, 0, 2, 0, 60, 1.5, 0, 0, 1)))
    with pytest.raises(dhpmap.InvalidArgument, match="the camera changes at stamp 250000000"):
        list(frames(recorded(tmp_path, other)))


@pytest.mark.parametrize("other, message", [
    (color(100, frame_id="color"), "/cam/color is in frame 'color', /cam/depth in 'camera': register depth to colour"),
    (color(100, width=2), "/cam/color has 2 x 3 pixels, /cam/camera_info says 4 x 3"),
    (color(100, "yuv422"), "/cam/color is of 'yuv422'; colour may be mono8, rgb8")],
    ids=("frame", "size", "encoding"))
def test_images_that_do_not_belong_together_are_told(tmp_path, other, message):
    with pytest.raises(dhpmap.InvalidArgument, match=message):
        list(frames(recorded(tmp_path, other, stamps_ms=(100,))))


def label_info(*pairs):
    cdr = made.header(made.Cdr(), 0, "").add("I", len(pairs))
    for number, name in pairs:
        cdr.add("HS", number, name)
    return "/info", "vision_msgs/msg/LabelInfo", 50, cdr.add("f", 0.5).bytes()


def labelled(tmp_path, info, pixels, encoding="mono16", **options):
    pixels = rows({"mono16": "<u2", "32SC1": "<i4"}[encoding], pixels)
    image = ("/labels", IMAGE, 100, made.image(100 * MS, encoding, pixels, 4))
    (got,) = frames(recorded(tmp_path, image, *info, stamps_ms=(100,)), **options)
    return got.labels.tolist(), {its.id: its.class_name for its in got.segments}


def test_ids_of_classes_without_a_name_are_no_labels(tmp_path):
    pixels = [[0, 1, 2, 9], [1, 1, 1, 1], [2, 2, 2, 65535]]
    info = label_info((0, "Unlabeled"), (1, "wall"), (2, "chair"), (3, "sofa"))
    assert labelled(tmp_path, [info], pixels) == ([[0, 1, 2, 0], [1, 1, 1, 1], [2, 2, 2, 0]], {1: "wall", 2: "chair"})


def test_a_class_0_shifts_all_ids_for_0_is_no_label(tmp_path):
    pixels = [[0, 1, 1, 255]] * 3
    assert labelled(tmp_path, [], pixels, classes={0: "wall", 1: "chair"}) == (
        [[1, 2, 2, 0]] * 3, {1: "wall", 2: "chair"})


def test_a_divisor_tells_things_of_a_class_apart(tmp_path):
    pixels = [[56001, 56002, 7000, 9001]] * 3
    assert labelled(tmp_path, [], pixels, classes={56: "chair", 7: "wall"}, label_divisor=1000) == (
        [[56001, 56002, 7000, 0]] * 3, {56001: "chair", 56002: "chair", 7000: "wall"})


def test_large_ids_and_those_below_0_are_taken_as_well(tmp_path):
    pixels = [[2_000_000_001, 2_000_000_002, -1, 1_000_000_000]] * 3
    got = labelled(tmp_path, [], pixels, "32SC1", classes={2000: "chair", 0: "wall"}, label_divisor=1_000_000)
    assert got == ([[2_000_000_002, 2_000_000_003, 0, 0]] * 3, {2_000_000_002: "chair", 2_000_000_003: "chair"})


def detections(*rows_of_them):
    cdr = made.header(made.Cdr(), 100 * MS, "").add("I", len(rows_of_them))
    for number, *hypotheses in rows_of_them:
        made.header(cdr, 100 * MS, "").add("I", len(hypotheses))
        for class_id, score in hypotheses:
            cdr.add("S" + "d" * 44, class_id, score, *[0] * 43)
        cdr.add("dddddS", 0, 0, 0, 0, 0, number)
    return "/detections", "vision_msgs/msg/Detection2DArray", 100, cdr.bytes()


def test_a_detection_is_a_segment_of_its_likeliest_class(tmp_path):
    table = detections(("7", ("sofa", 0.2), ("chair", 0.7)), ("9", ("3", 0.5)), ("11",))
    pixels = [[7, 9, 11, 12]] * 3
    assert labelled(tmp_path, [table], pixels, classes={3: "lamp"}) == (
        [[7, 9, 11, 0]] * 3, {7: "chair", 9: "lamp", 11: None})


@pytest.mark.parametrize("number", ["", "0", "a", "-3", "99999999999"], ids=("empty", "zero", "text", "minus", "large"))
def test_a_detection_whose_id_is_no_pixel_value_is_told(tmp_path, number):
    with pytest.raises(dhpmap.InvalidArgument, match="/detections: a detection has the id"):
        labelled(tmp_path, [detections((number, ("chair", 1)))], [[1] * 4] * 3)


def test_labels_that_nothing_explains_are_told(tmp_path):
    with pytest.raises(dhpmap.InvalidArgument, match="nothing says what the ids of /labels are: say label_table="):
        labelled(tmp_path, [], [[1] * 4] * 3)


@pytest.mark.parametrize("options, message", [
    ({"depth": "/none"}, r"depth='/none': there is no such topic; there are /cam/camera_info \(sensor_msgs"),
    ({"depth": "/tf"}, "depth='/tf' is of tf2_msgs/msg/TFMessage .*wanted sensor_msgs/msg/Image"),
    ({"depth": "/a", "cloud": "/b"}, "depth and cloud are both given"),
    ({"dept": "/a"}, "there is no option 'dept'; there are depth, cloud"),
    ({"depth": ""}, "no topic holds depth images or clouds"),
    ({"camera_info": "/cam/depth"}, "wanted sensor_msgs/msg/CameraInfo")],
    ids=("no_topic", "type", "two_leads", "no_option", "none", "camera_info"))
def test_topics_that_are_not_meant_are_told(tmp_path, options, message):
    with pytest.raises(dhpmap.InvalidArgument, match=message):
        frames(recorded(tmp_path), **options)


def test_one_of_several_topics_must_be_said(tmp_path):
    path = recorded(tmp_path, color(100), color(100, topic="/other/rgb"), stamps_ms=(100,))
    with pytest.raises(dhpmap.InvalidArgument, match="may be color: /cam/color, /other/rgb: say which by color="):
        frames(path)
    assert len(list(frames(path, color="/other/rgb"))) == 1


@pytest.mark.parametrize("cut", [3, 10, 20, 40])
def test_a_message_that_ends_too_early_is_told(tmp_path, cut):
    recording = made.Recording().add("/cam/camera_info", INFO, made.camera_info(0, 4, 3), 0)
    recording.add("/cam/depth", IMAGE, made.image(0, "16UC1", DEPTH, 4)[:cut], 0)
    with pytest.raises(dhpmap.DataLoss, match="a message of sensor_msgs/msg/Image"):
        list(frames(recording.write(tmp_path / "its.mcap")))


def test_messages_of_another_layout_are_told(tmp_path):
    image = made.image(0, "16UC1", DEPTH, 4)
    for data, message in ((b"\0\7" + image[2:], "not in plain CDR"), (image + bytes(20), "of another version")):
        recording = made.Recording().add("/cam/camera_info", INFO, made.camera_info(0, 4, 3), 0)
        recording.add("/cam/depth", IMAGE, data, 0)
        with pytest.raises(dhpmap.Unimplemented, match=message):
            list(frames(recording.write(tmp_path / "its.mcap")))


XYZ = [("x", 0, 7), ("y", 4, 7), ("z", 8, 7)]


def beside_a_cloud(tmp_path, *more, image_ms=110, label_frame="camera"):
    """A cloud at 100 ms, and images at another time, 10 mm further on for each 10 ms."""
    cloud = made.point_cloud(100 * MS, XYZ, 12, [struct.pack("<3f", 0.1, 0.2, 2), struct.pack("<3f", 0, 0, 5)])
    lidar = made.transforms((0, "base", "lidar", (0, 0, 2), (0, 0, 0, 1)))
    labels = made.image(image_ms * MS, "16UC1", rows("<u2", [[0, 10, 10, 0]] * 3), 4, label_frame)
    its = [("/tf_static", TF, 0, lidar), ("/points", "sensor_msgs/msg/PointCloud2", 100, cloud), color(image_ms),
           ("/cam/labels", IMAGE, image_ms, labels), *more]
    return recorded(tmp_path, *its, stamps_ms=(100,))


def test_images_beside_a_cloud_are_seen_from_where_the_lidar_was(tmp_path):
    (got,) = frames(beside_a_cloud(tmp_path), cloud="/points", color="/cam/color", labels="/cam/labels",
                    classes={10: "car"})
    K = np.array([[50, 0, 2], [0, 50, 1.5], [0, 0, 1]])
    T_camera_lidar = np.array([[1, 0, 0, -0.01], [0, 1, 0, 0], [0, 0, 1, 1]])  # the camera came later, and lies lower
    assert np.allclose(got.image.P_image_lidar, K @ T_camera_lidar, atol=1e-9)
    assert got.image.rgb.shape == (3, 4, 3) and (got.image.labels == [[0, 10, 10, 0]] * 3).all()
    assert [(its.id, its.class_name) for its in got.segments] == [(10, "car")]
    assert got.segment_ids is None and got.rgb is None and got.T_map_lidar[:3, 3].round(9).tolist() == [0.1, 0, 2]
    (bare,) = frames(beside_a_cloud(tmp_path), cloud="/points")
    assert bare.image is None and bare.segments is None


def test_a_cloud_without_an_image_of_its_time_is_left_out(tmp_path):
    path, options = beside_a_cloud(tmp_path, image_ms=150), {"cloud": "/points", "color": "/cam/color"}
    with pytest.warns(McapWarning, match="of 1 frames, 1 were left out for want of an image"):
        assert not list(frames(path, **options))
    assert len(list(frames(path, tolerance_s=0.06, **options))) == 1


def test_images_beside_a_cloud_are_of_one_camera_and_labels_of_one_kind(tmp_path):
    images = {"cloud": "/points", "color": "/cam/color", "labels": "/cam/labels", "classes": {10: "car"}}
    with pytest.raises(dhpmap.InvalidArgument, match="'camera'.*'base': images beside a cloud are of one camera"):
        list(frames(beside_a_cloud(tmp_path, label_frame="base"), **images))
    with pytest.raises(dhpmap.InvalidArgument, match="labels and label_field are both given"):
        frames(beside_a_cloud(tmp_path), label_field="label", **images)


def test_a_cloud_of_either_byte_order_leaves_out_what_is_no_return(tmp_path):
    fields = [("x", 0, 7), ("y", 4, 7), ("z", 8, 7), ("rgb", 12, 7), ("label", 16, 4)]
    for order, is_big in (("<", 0), (">", 1)):
        points = [struct.pack(order + "fffIHxx", x, 2, 3, 0x00102030, 10) for x in (1, np.nan, 5)]
        cloud = made.point_cloud(100 * MS, fields, 20, points, "camera", is_big)
        path = recorded(tmp_path, ("/points", "sensor_msgs/msg/PointCloud2", 100, cloud))
        (got,) = frames(path, cloud="/points", label_field="label", classes={10: "car"})
        assert got.points_m.tolist() == [[1, 2, 3], [5, 2, 3]] and got.rgb.tolist() == [[16, 32, 48]] * 2
        assert got.segment_ids.tolist() == [10, 10] and [its.class_name for its in got.segments] == ["car"]
        assert got.T_map_lidar[:3, 3].tolist() == [0.1, 0, 1]


@pytest.mark.parametrize("fields, step, message", [
    ([("x", 0, 7), ("y", 4, 7)], 12, "points need x, y and z"), ([("x", 10, 7)], 12, "reaches beyond a point"),
    ([("x", 0, 7), ("y", 4, 7), ("z", 8, 7)], 12, "no integer field 'label'")],
    ids=("no_z", "field", "no_label"))
def test_clouds_without_points_or_labels_are_told(tmp_path, fields, step, message):
    cloud = made.point_cloud(100 * MS, fields, step, [bytes(12)] * 3, "camera")
    path = recorded(tmp_path, ("/points", "sensor_msgs/msg/PointCloud2", 100, cloud))
    with pytest.raises(dhpmap.Error, match=message):
        list(frames(path, cloud="/points", label_field="label", classes={10: "car"}))


def test_any_damaged_byte_of_a_recording_is_an_error_of_ours_or_none(tmp_path):
    fields = [("x", 0, 7), ("y", 4, 7), ("z", 8, 7), ("label", 12, 4)]
    cloud = made.point_cloud(100 * MS, fields, 16, [bytes(16)] * 2, "camera")
    labels = ("/labels", IMAGE, 100, made.image(100 * MS, "mono16", DEPTH, 4))
    path = recorded(tmp_path, color(100), labels, detections(("7", ("chair", 0.7))), label_info((1, "wall")),
                    ("/points", "sensor_msgs/msg/PointCloud2", 100, cloud), stamps_ms=(100,), moving_ms=(90, 110))
    data = path.read_bytes()
    images = {"depth": "/cam/depth", "color": "/cam/color", "labels": "/labels", "label_table": "/detections"}
    points = {"cloud": "/points", "label_field": "label", "label_table": "/info"}
    outcomes = set()
    for options in (images, points):
        for at in range(0, len(data), 23):
            path.write_bytes(data[:at] + bytes([data[at] ^ 0xFF]) + data[at + 1:])
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", McapWarning)  # any other is an error
                try:
                    list(frames(path, **options))
                    outcomes.add("frames")
                except dhpmap.Error as error:
                    outcomes.add(type(error).__name__)
    assert {"frames", "DataLoss", "InvalidArgument", "Gap"} <= outcomes
