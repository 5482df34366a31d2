#!/usr/bin/python3 -B
# SPDX-License-Identifier: BSD-3-Clause
"""What a page holds while a map changes on and on: live_memory.py PROGRAMS FOLDER MINUTES.

The walk is fed again and again, with things moved and renamed in between; a line a minute.
"""
import os
import sys
import time

from browser import Page
from served_map import Server, render

MAP = "live"


def memory_of(page):
    """Bytes of script after all that can be freed is; surfaces in the scene, and their bytes."""
    page.driver.execute_cdp_cmd("HeapProfiler.collectGarbage", {})
    page.driver.execute_cdp_cmd("Performance.enable", {})
    metrics = page.driver.execute_cdp_cmd("Performance.getMetrics", {})["metrics"]
    heap = next(each["value"] for each in metrics if each["name"] == "JSHeapUsedSize")
    nodes = next(each["value"] for each in metrics if each["name"] == "Nodes")
    return heap, nodes, *page.js("return [r.geometries, r.meshBytes, s.get('objects').size, s.get('revision')]")


def say(minute, page):
    heap, nodes, geometries, surfaces, objects, revision = memory_of(page)
    print(f"{minute:3d} min: heap {heap / 1e6:6.1f} MB, {nodes:.0f} nodes, {geometries} geometries, "
          f"{surfaces / 1e6:.1f} MB of surfaces, {objects} objects, revision {revision}", flush=True)


def shake(server, turn):
    """Some things go there and back."""
    things = [each for each in server.objects(MAP).values() if each["kind"] == "THING"][:5]
    offset = {"x": 0.2 if turn % 2 == 0 else -0.2}
    server.ask(f"maps/{MAP}:applyEdits", {"author": "anna", "edits": [
        {"submap": each["name"], "translate": {"offset_m": offset}} for each in things]})


def main(programs, folder, minutes):
    os.makedirs(folder, exist_ok=True)
    data = os.path.join(folder, "apartment")
    data = data if os.path.exists(data) else render(programs, folder)
    server = Server(programs, folder, "live")
    try:
        server.feed(data, "--map", MAP, "--labels", "groundtruth", "--frames", "10", "--no-finish").communicate()
        page = Page(server.url)
        page.open(f"map={MAP}")
        begin_s, turn, minute = time.monotonic(), 0, 0
        while minute < int(minutes):
            server.feed(data, "--map", MAP, "--labels", "groundtruth", "--no-finish").communicate()
            shake(server, turn)
            turn += 1
            page.hear()
            page.requests.clear()
            if (time.monotonic() - begin_s) / 60 >= minute + 1:
                minute += 1
                page.until("v.surfaces.isIdle && r.isResting")
                say(minute, page)
        page.close()
        print(f"{turn} walks")
    finally:
        server.stop()


if __name__ == "__main__":
    main(*sys.argv[1:4])
