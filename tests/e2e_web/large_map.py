#!/usr/bin/python3 -B
# SPDX-License-Identifier: BSD-3-Clause
"""A map of 1,000 objects and millions of triangles for measure.py: large_map.py PROGRAMS FOLDER. Serves it until Enter.

The things of the simulated apartment, finely mapped, and copies of them in rows beside it.
"""
import os
import sys

from served_map import Server, render

MAP = "large"
FINE = ["--set", "voxel_size_m=0.019", "--set", "truncation_m=0.06"]
OBJECTS = 1000
STEP_M = 12  # from copy to copy: an apartment and a corridor
AT_ONCE = 100


def clones(objects, wanted):
    """Edits that make so many copies, each apartment of copies in a place of its own."""
    things = [each for each in objects.values() if each["kind"] == "THING" and "bounding_sphere" in each]
    edits = []
    for number in range(wanted):
        thing, row = things[number % len(things)], 1 + number // len(things)
        pose = thing["map_from_submap"]
        place = dict(pose["translation_m"])
        place["x"] += STEP_M * (row % 3)
        place["y"] += STEP_M * (row // 3)
        edits.append({"submap": thing["name"], "clone": {"map_from_submap": {**pose, "translation_m": place}}})
    return edits


def main(programs, folder):
    os.makedirs(folder, exist_ok=True)
    server = Server(programs, folder, "large")
    try:
        if not any(each["name"] == f"maps/{MAP}" for each in server.ask("maps").get("maps", [])):
            data = os.path.join(folder, "apartment")
            data = data if os.path.exists(data) else render(programs, folder)
            feeding = server.feed(data, "--map", MAP, "--labels", "groundtruth", *FINE)
            assert feeding.wait() == 0, feeding.stderr.read().decode()
            objects = server.objects(MAP)
            edits = clones(objects, OBJECTS - len(objects))
            for begin in range(0, len(edits), AT_ONCE):
                server.ask(f"maps/{MAP}:applyEdits", {"edits": edits[begin:begin + AT_ONCE]})
        print(f"{server.url} {MAP}", flush=True)
        sys.stdin.readline()
    finally:
        server.stop()


if __name__ == "__main__":
    main(*sys.argv[1:3])
