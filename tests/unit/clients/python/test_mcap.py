# SPDX-License-Identifier: BSD-3-Clause
"""Recordings that other people's writers wrote of the simulator's frames (make_mcap.mjs), and maps of them."""
import json
import pathlib
import zlib

import grpc
import numpy as np
import pytest

import dhpmap
import dhpmap.mcap
from dhpmap.mcap.__main__ import main
from scripted_server import ScriptedServer

FOLDER = pathlib.Path(__file__).parent / "mcap"
TRUTH = json.loads((FOLDER / "truth.json").read_text())
STUFF = ("wall", "floor", "ceiling", "window", "curtain")


def classes():
    return [dhpmap.Label(number, name, "stuff" if name in STUFF else "thing")
            for number, name in sorted(dict(TRUTH["classes"].values()).items())]


def all_frames(name, **options):
    if name == "packed":
        pytest.importorskip("lz4.frame")
        pytest.importorskip("zstandard")
    frames = list(dhpmap.mcap.frames(FOLDER / f"{name}.mcap", **options))
    for frame, true in zip(frames, TRUTH["frames"]):
        pose = frame.T_map_lidar if name == "scan" else frame.T_map_camera
        assert frame.stamp_ns == int(true["stamp_ns"])
        assert np.abs(pose - np.reshape(true["pose"], (4, 4))).max() < 1e-8
    return frames


def test_a_walk_comes_back_as_it_was_recorded():
    frames = all_frames("walk")
    assert len(frames) == 6
    for frame, true in zip(frames, TRUTH["frames"]):
        assert (frame.depth.dtype, frame.depth_scale_m, frame.depth.shape) == (np.uint16, 0.001, (48, 64))
        assert zlib.crc32(frame.depth.tobytes()) == true["depth_crc"]
        assert zlib.crc32(frame.rgb.tobytes()) == true["rgb_crc"]
        assert zlib.crc32(frame.labels.astype(np.uint16).tobytes()) == true["labels_crc"]
        assert frame.camera == dhpmap.Camera(*TRUTH["camera"])
        seen = {int(its) for its in np.unique(frame.labels)} - {0}
        assert {its.id for its in frame.segments} == seen
        assert all(its.class_name == TRUTH["classes"][str(its.id)][1] and its.score == 0.9 for its in frame.segments)


def test_packed_images_and_ids_of_class_and_number_come_back():
    frames, walk = all_frames("packed", label_divisor=1000), all_frames("walk")
    assert len(frames) == 3
    for frame, same in zip(frames, walk):
        assert frame.depth.startswith(b"\x89PNG") and frame.rgb.startswith(b"\x89PNG")
        assert np.array_equal(frame.labels % 1000, same.labels)
        names = {its.id % 1000: its.class_name for its in frame.segments}
        assert names == {its.id: its.class_name for its in same.segments}


def test_a_scan_comes_back_with_colours_and_labels():
    (scan,), walk = all_frames("scan", label_field="label"), all_frames("walk")[0]
    every_other = (slice(None, None, 2), slice(None, None, 2))
    is_return = (walk.depth[every_other] > 0).ravel()
    assert np.allclose(scan.points_m[:, 2], walk.depth[every_other].ravel()[is_return] / 1000, atol=1e-6)
    assert np.array_equal(scan.rgb, walk.rgb[every_other].reshape(-1, 3)[is_return])
    true = [TRUTH["classes"].get(str(its), [0])[0] for its in walk.labels[every_other].ravel()[is_return].tolist()]
    assert scan.segment_ids.tolist() == true
    names = dict(TRUTH["classes"].values())
    assert {its.class_name for its in scan.segments} == {names[its] for its in set(true) - {0}}


def objects_of(target):
    return [(its.id, its.class_name, *its.box.center_m.round(3), *its.box.size_m.round(3)) for its in target.objects]


def test_a_map_of_a_recording_is_that_of_its_arrays(connection):
    recorded, by_hand = (connection.create(name, classes()) for name in ("mcap_recorded", "mcap_by_hand"))
    fed = recorded.feed_mcap(FOLDER / "walk.mcap", "robot1", persistent_ids=True)
    assert fed == dhpmap.mcap.Fed(6, 0, 0, 0)
    with by_hand.feed("robot1", camera=dhpmap.Camera(*TRUTH["camera"]), persistent_ids=True) as feed:
        for its in all_frames("walk"):
            feed.rgbd(its.depth.astype(np.float32) * np.float32(0.001), its.rgb, its.labels,
                      {one.id: one.class_name for one in its.segments}, its.T_map_camera, its.stamp_ns)
    assert recorded.info.num_frames == 6 and {"sofa", "rug"} <= {its.class_name for its in recorded.objects}
    assert objects_of(recorded) == objects_of(by_hand)


def test_packed_images_make_the_map_that_plain_ones_make(connection):
    frames = all_frames("packed", label_divisor=1000)
    packed, plain = (connection.create(name, classes()) for name in ("mcap_packed", "mcap_plain"))
    packed.feed_mcap(FOLDER / "packed.mcap", "robot1", label_divisor=1000)
    with plain.feed("robot1", camera=dhpmap.Camera(*TRUTH["camera"]), depth_scale_m=0.001) as feed:
        for its, labels in zip(all_frames("walk"), frames):
            feed.rgbd(its.depth, its.rgb, labels.labels, labels.segments, its.T_map_camera, its.stamp_ns)
    assert len(objects_of(packed)) > 5 and objects_of(packed) == objects_of(plain)
    same, mesh = (its.mesh(its.find("sofa")[0]) for its in (packed, plain))
    assert len(same.rgb) == pytest.approx(len(mesh.rgb), rel=0.02)  # files and arrays are scaled in other orders
    assert np.abs(same.rgb.mean(axis=0) - mesh.rgb.mean(axis=0)).max() < 0.5


def test_a_scan_goes_into_a_map(connection):
    target = connection.create("mcap_scan", classes(), preset="outdoor_lidar")
    assert target.feed_mcap(FOLDER / "scan.mcap", "robot1", label_field="label").num_frames == 1
    assert target.info.num_frames == 1


def test_the_command_lists_a_recording_and_feeds_it(server, connection, capsys):
    assert main([str(FOLDER / "walk.mcap"), "--info"]) == 0
    said = capsys.readouterr().out
    assert "/camera/depth/image_raw          6  sensor_msgs/msg/Image (cdr)  depth" in said
    assert "labels /panoptic/labels, label_table /panoptic/detections" in said
    connection.create("mcap_command", classes())
    arguments = ["--map", "mcap_command", "--server", server.address, "--persistent-ids"]
    assert main([str(FOLDER / "walk.mcap"), *arguments]) == 0
    assert "Fed(num_frames=6" in capsys.readouterr().out and connection["mcap_command"].info.num_frames == 6


def test_the_command_makes_a_map_of_a_label_set(server, connection, capsys):
    arguments = [str(FOLDER / "walk.mcap"), "--map", "mcap_new", "--server", server.address, "--labels", ""]
    assert main(arguments) == 1
    assert "mcap_new" in capsys.readouterr().err
    assert main([*arguments, "--label-set", "coco_panoptic"]) == 0
    assert len(connection["mcap_new"].info.classes) == 133 and connection["mcap_new"].info.num_frames == 6


def test_the_command_shows_a_key_and_trusts_whom_it_is_told(tmp_path, capsys):
    key = tmp_path / "anna.key"
    key.write_text("secret\n")
    key.chmod(0o600)
    walk, refusal = str(FOLDER / "walk.mcap"), (grpc.StatusCode.PERMISSION_DENIED, "not yours")
    with ScriptedServer(refusal) as server:
        assert main([walk, "--map", "a", "--server", server.address, "--token-file", str(key)]) == 1
    assert server.metadata[0]["authorization"] == "Bearer secret"
    assert "not yours" in capsys.readouterr().err
    elsewhere = [walk, "--map", "a", "--server", "robot.example:50051", "--token-file", str(key)]
    assert main(elsewhere) == 1 and "in the clear" in capsys.readouterr().err
    assert main([*elsewhere, "--ca", str(tmp_path / "none")]) == 1 and "none" in capsys.readouterr().err


def test_the_command_says_what_is_wrong(capsys):
    assert main(["none.mcap", "--info"]) == 1
    assert capsys.readouterr().err == "dhpmap.mcap: there is no recording none.mcap\n"
    with pytest.raises(SystemExit):
        main(["none.mcap"])
    assert main([str(FOLDER / "walk.mcap"), "--info", "--depth", "/camera/color/image_raw", "--cloud", "/c"]) == 0
    assert "as it stands it cannot be fed: depth and cloud are both given" in capsys.readouterr().out
