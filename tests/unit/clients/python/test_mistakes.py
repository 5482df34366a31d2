# SPDX-License-Identifier: BSD-3-Clause
"""What is wrong is told before it is sent, with what to do."""
import numpy as np
import pytest

import dhpmap
from dhpmap import _arrays, _camera, _frames, _options, _pose


@pytest.mark.parametrize("values, says", [
    ([1, 2], r"wanted shape \(..., 3\)"), (np.ones((3, 8)), "transpose it"), ([[1, 2, np.nan]], r"index \[0, 2\]"),
    ("abc", "got a str"), (np.ones((4, 3), complex), "complex128"), (np.ones((4, 3), bool), "bool"),
    ([[1, 2, 3], [4, 5]], "wanted an array of real numbers")], ids=range(7))
def test_points_that_are_none(values, says):
    with pytest.raises(dhpmap.InvalidArgument, match=says) as caught:
        _arrays.rows("points_m", values, 3, "x, y, z")
    assert caught.value.violations[0].field == "points_m"


def test_points_of_any_kind_of_numbers_are_taken():
    for values in ([[1, 2, 3]], np.ones((1, 3), np.int16), np.ones((1, 3), np.float16), [(1.5, np.float32(2), 3)]):
        rows, shape = _arrays.rows("points_m", values, 3, "")
        assert rows.dtype == np.float32 and rows.shape == (1, 3) and shape == (1,)
    assert _arrays.rows("points_m", [], 3, "")[0].shape == (0, 3)


def turned(matrix=np.eye(3), at=(0, 0, 0)):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = matrix, at
    return T


@pytest.mark.parametrize("matrix, says", [
    (turned(np.diag((1, 1, -1))), "left-handed"), (turned(1.1 * np.eye(3)), "scales by 1.1"),
    (turned(at=(1, 2, 3)).T, "transposed"), (np.eye(3), "4 x 4"), (turned(np.ones((3, 3))), "not rigid")], ids=range(5))
def test_poses_that_are_not_rigid_or_left_handed(matrix, says):
    with pytest.raises(dhpmap.InvalidArgument, match=says):
        _arrays.rigid("T_map_camera", matrix)


def test_poses_survive_their_message():
    random = np.random.default_rng(5)
    for _ in range(200):
        rotation = np.linalg.qr(random.normal(size=(3, 3)))[0]
        T = turned(rotation * np.linalg.det(rotation), random.normal(size=3))
        np.testing.assert_allclose(_pose.read_pose(_pose.pose_message("T", T)), T, atol=1e-12)
    for axis in range(3):  # half turns, where a quaternion's w is 0
        half = -np.eye(3)
        half[axis, axis] = 1
        np.testing.assert_allclose(_pose.read_pose(_pose.pose_message("T", turned(half))), turned(half), atol=1e-12)


def test_intrinsics_of_another_image_size():
    K = [[500, 0, 320], [0, 500, 240], [0, 0, 1]]
    assert dhpmap.Camera.from_matrix(K, 640, 480).fx_px == 500
    with pytest.raises(dhpmap.InvalidArgument, match="an image 2 times as large"):
        dhpmap.Camera.from_matrix(K, 320, 240)
    with pytest.raises(dhpmap.InvalidArgument, match="an image 0.5 times as large"):
        dhpmap.Camera.from_matrix(K, 1280, 960)
    assert dhpmap.Camera(320, 240, 500, 500, 10, 120, off_centre=True).cx_px == 10


SHAPE = (6, 8)


@pytest.mark.parametrize("depth, scale_m, says", [
    (np.ones((8, 6), np.float32), None, "transpose it"), (np.ones((6, 8), np.uint16), None, "depth_scale_m=0.001"),
    (np.full((6, 8), 1500.0), None, "divide millimetres by 1000"),
    (np.full((6, 8), 1500, np.uint16), 1, "of millimetres it is 0.001"),
    (np.ones((6, 8), np.int32), None, "float metres or uint16"),
    (np.ones((6, 8)), 0.001, "without depth_scale_m")], ids=range(6))
def test_depth_of_a_wrong_kind(depth, scale_m, says):
    with pytest.raises(dhpmap.InvalidArgument, match=says):
        _camera.depth_image(depth, SHAPE, scale_m)


def test_colour_and_labels_of_a_wrong_kind():
    with pytest.raises(dhpmap.InvalidArgument, match="multiply by 255"):
        _camera.color_image(np.ones((6, 8, 3)), SHAPE)
    with pytest.raises(dhpmap.InvalidArgument, match="integer segment ids"):
        _camera.label_image(np.ones((6, 8)), SHAPE)
    with pytest.raises(dhpmap.InvalidArgument, match="ids below 0"):
        _camera.label_image(np.full((6, 8), -1), SHAPE)
    with pytest.raises(dhpmap.InvalidArgument, match="the map has no class 'chiar'; it has chair, wall"):
        _frames.segment_messages({1: "chiar"}, {"chair": 3, "wall": 4})


@pytest.mark.parametrize("greatest, octets", [(255, 1), (256, 2), (65535, 2), (65536, 4)])
def test_labels_go_in_the_smallest_type_that_holds_them(greatest, octets):
    labels = np.zeros((6, 8), np.int64)
    labels[2, 3] = greatest
    image, most = _camera.label_image(labels, SHAPE)
    assert len(image.data) == 48 * octets and most == greatest
    np.testing.assert_array_equal(np.frombuffer(image.data, f"<u{octets}").reshape(6, 8), labels)


def test_stamps_that_go_back_or_are_seconds():
    assert _frames.checked_stamp(np.int64(2), 1) == 2
    with pytest.raises(dhpmap.InvalidArgument, match="lies 1e-09 s before"):
        _frames.checked_stamp(1, 2)
    with pytest.raises(dhpmap.InvalidArgument, match="repeats"):
        _frames.checked_stamp(2, 2)
    with pytest.raises(dhpmap.InvalidArgument, match=r"int\(t \* 1e9\)"):
        _frames.checked_stamp(1.5, None)


def test_options_that_there_are_not():
    with pytest.raises(TypeError, match="did you mean 'ignore'"):
        _options.options_message("maps/a", {"ignored": [1]})
    with pytest.raises(dhpmap.InvalidArgument, match="wanted a list, got 'sofa'; write"):
        _options.options_message("maps/a", {"ignore": "sofa"})
    with pytest.raises(dhpmap.InvalidArgument, match="none of 'report', 'free', 'occupied'"):
        _options.options_message("maps/a", {"unknown": "FREE"})
    with pytest.raises(dhpmap.InvalidArgument, match="wanted an object or its id, got a float"):
        _options.options_message("maps/a", {"ignore": [1.0]})


def test_options_reach_their_fields():
    message = _options.options_message("maps/a", {
        "ignore": [3, "rug"], "padding_m": 0.1, "padding_of": {"chair": 0.2, 4: 0.3}, "attached": {7: np.eye(4)},
        "may_touch": {"wheel": ["floor"], None: [5]}, "unknown": "free", "vacated": "free", "T_map_query": np.eye(4)})
    assert list(message.excluded_submaps) == ["maps/a/submaps/3"] and list(message.excluded_class_names) == ["rug"]
    assert message.padding.default_padding_m == 0.1 and message.padding.classes[0].padding_m == 0.2
    assert message.padding.submaps[0].submap == "maps/a/submaps/4" and message.attached[0].submap == "maps/a/submaps/7"
    allowed = message.allowed_collisions
    assert (allowed[0].link, allowed[0].class_name, allowed[1].submap) == ("wheel", "floor", "maps/a/submaps/5")


def test_an_object_of_another_map_is_refused(sofa):
    with pytest.raises(dhpmap.InvalidArgument, match="is of maps/apartment, not of maps/other"):
        _options.options_message("maps/other", {"ignore": [sofa]})


def test_robots_and_boxes_that_are_none():
    with pytest.raises(dhpmap.InvalidArgument, match=r"wanted \(S, 4\)"):
        dhpmap.Spheres([(0, 0, 0.3)])
    with pytest.raises(dhpmap.InvalidArgument, match="below 0"):
        dhpmap.Spheres([(0, 0, 0, -0.3)])
    with pytest.raises(dhpmap.InvalidArgument, match="is not below max_m"):
        dhpmap.Box((1, 1, 1), (0, 2, 2))
    with pytest.raises(dhpmap.InvalidArgument, match=r"\(H, 3\)"):
        _pose.read_path("waypoints", [(1, 2)])


def test_a_label_of_another_kind_is_said_before_anything_is_sent(connection):
    with pytest.raises(dhpmap.InvalidArgument, match="labels: Label.*'stuf'.* kind than thing, stuff"):
        connection.create("x", [dhpmap.Label(1, "wall", "stuf")])  # type: ignore[arg-type]
