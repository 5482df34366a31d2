# SPDX-License-Identifier: BSD-3-Clause
"""Label sets of data sets: their counts and ids, for servers and as label tables of the flat layout."""
import pathlib
import re
import subprocess

import pytest

import dhpmap

ROOT = pathlib.Path(__file__).resolve().parents[4]
COUNTS = {"ade20k_150": (150, 100, 150), "cityscapes": (19, 8, 19), "coco_panoptic": (133, 80, 133),
          "semantic_kitti": (32, 18, 19)}  # classes, things, classes of networks


def test_all_sets_are_listed():
    assert dhpmap.label_sets() == sorted(COUNTS)


@pytest.mark.parametrize("name", COUNTS)
def test_a_set_has_its_classes_each_once(name):
    classes, things, of_networks = COUNTS[name]
    for ids, count in (("data_set", classes), ("network", of_networks)):
        labels = dhpmap.label_set(name, ids=ids)
        assert len(labels) == count == len({its.id for its in labels}) == len({its.name for its in labels})
        assert [its.id for its in labels] == sorted(its.id for its in labels)
    assert sum(its.kind == "thing" for its in dhpmap.label_set(name)) == things
    first = 1 if name == "semantic_kitti" else 0  # 0 is unlabeled there
    assert {its.id for its in labels} == set(range(first, first + of_networks))


@pytest.mark.parametrize("name, known", [
    ("coco_panoptic", {1: ("person", 0), 62: ("chair", 56), 90: ("toothbrush", 79), 92: ("banner", 80),
                       200: ("rug-merged", 132)}),
    ("ade20k_150", {1: ("wall", 0), 20: ("chair", 19), 142: ("crt screen", 141), 150: ("flag", 149)}),
    ("cityscapes", {7: ("road", 0), 24: ("person", 11), 33: ("bicycle", 18)}),
    ("semantic_kitti", {10: ("car", 1), 40: ("road", 9), 81: ("traffic-sign", 19)})])
def test_ids_are_those_of_the_data_set_and_of_its_networks(name, known):
    by_data_set = {its.id: its.name for its in dhpmap.label_set(name)}
    by_network = {its.name: its.id for its in dhpmap.label_set(name, ids="network")}
    assert {number: (by_data_set[number], by_network[by_data_set[number]]) for number in known} == known


def test_semantic_kitti_is_that_of_the_command_line():
    rows = re.findall(r'\{(\d+), "([^"]+)", k(\w+), k(\w)\}',
                      (ROOT / "clients/datasets/semantic_kitti_classes.cc").read_text())
    assert [(str(its.id), its.name, its.kind.capitalize(), its.size[0].upper())
            for its in dhpmap.label_set("semantic_kitti")] == rows and len(rows) == 32


def test_a_name_that_is_none_names_those_that_are():
    with pytest.raises(dhpmap.InvalidArgument, match="no label set 'coco'; there are ade20k_150, cityscapes"):
        dhpmap.label_set("coco")
    with pytest.raises(dhpmap.InvalidArgument, match="'data_set' or 'network'"):
        dhpmap.label_set("cityscapes", ids="train")


@pytest.mark.parametrize("name", COUNTS)
def test_a_server_takes_a_set_and_the_command_line_its_file(connection, programs, server, tmp_path, name):
    labels = dhpmap.label_set(name)
    assert list(connection.create(f"set_{name}", labels).info.classes) == labels
    (tmp_path / "run1").mkdir()
    (tmp_path / "run1/timestamps.csv").write_text("ImageID,TimeStamp\n000000,1\n")
    table = ROOT / f"clients/python/dhpmap/label_sets/{name}.csv"
    (tmp_path / "detectron_labels.csv").write_bytes(table.read_bytes())
    create = ["maps", "create", f"file_{name}", "--dataset", tmp_path]
    subprocess.run([programs / "dhpmap", "--server", server.address, *create], check=True, stdout=subprocess.DEVNULL)
    assert list(connection[f"file_{name}"].info.classes) == labels
