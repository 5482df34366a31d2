# SPDX-License-Identifier: BSD-3-Clause
"""The Python of README.md and of the pages that have some runs as it stands."""
import importlib.util
import pathlib
import re
import shutil

import pytest

import dhpmap

ROOT = pathlib.Path(__file__).resolve().parents[4]


@pytest.mark.parametrize("page, prints", [
    ("README.md", ("changed", "Undone(")), ("docs/python.md", ("did you mean 'sofa'",)),
    ("docs/feeding.md", ("name='chair', kind='thing'", "['', 'wall-other-merged', 'chair']", "Fed(num_frames=6,"))],
    ids=("README", "docs_python", "docs_feeding"))
def test_the_python_of_a_page_runs(page, prints, server, monkeypatch, tmp_path, capsys):
    blocks = re.findall(r"^```python\n(.*?)^```$", (ROOT / page).read_text(), re.DOTALL | re.MULTILINE)
    assert blocks
    connect = dhpmap.connect
    monkeypatch.setattr(dhpmap, "connect", lambda address, **options: connect(server.address, **options))
    monkeypatch.chdir(tmp_path)
    shutil.copy(ROOT / "tests/unit/clients/python/mcap/walk.mcap", tmp_path)
    names = {}
    for block in blocks:
        exec(compile(block, page, "exec"), names)
    said = capsys.readouterr().out
    assert all(its in said for its in prints), said


def test_the_example_finds_a_way_to_the_nearest_chair(server, apartment, capsys):
    spec = importlib.util.spec_from_file_location("path_to_chair", ROOT / "clients/python/examples/path_to_chair.py")
    example = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(example)
    path = example.main(server.address, "apartment", "2", "1.2")
    assert "waypoints" in capsys.readouterr().out and len(path) > 5
    nearest = apartment.find("chair", near=path[-1])[0]
    assert nearest.distance_m < 1.2 and not apartment.collisions([(*place, 0.25) for place in path]).colliding.any()
