#!/usr/bin/python3 -B
# SPDX-License-Identifier: BSD-3-Clause
"""What a map costs in the viewer: measure.py URL MAP. At 1280 x 800, in this machine's Chromium without a GPU.

Processor times count where other programs take the machine, too; frames a second then do not.
"""
import json
import os
import sys

from browser import Page

FRAMES = 30

TURN = """
const [most, done] = arguments;
const { renderer } = window.dhpmap;
const middle = renderer.bounds().getCenter(renderer.camera.three.position.clone());
const begin_ms = performance.now(), first = renderer.frames.drawn;
const turn = () => {
  const drawn = renderer.frames.drawn - first;
  if (drawn >= most) return done([drawn / (performance.now() - begin_ms) * 1000, renderer.drawnTriangles]);
  renderer.camera.orbit(middle, 4, 0);
  requestAnimationFrame(turn);
};
turn();"""

FIRST = """
const done = arguments[arguments.length - 1];
const look = () => {
  const v = window.dhpmap;
  if (v && v.store.get("phase").is === "ready" && v.renderer.drawnTriangles > 100) done(performance.now());
  else requestAnimationFrame(look);
};
look();"""


def processor_s(root):
    """Of a process and all below it, but those that have ended."""
    ticks, parents = {}, {}
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{pid}/stat", encoding="utf8") as file:
                fields = file.read().rpartition(")")[2].split()
        except OSError:
            continue
        parents[pid], ticks[pid] = fields[1], int(fields[11]) + int(fields[12])
    total = 0
    for pid, own in ticks.items():
        each = pid
        while each in parents and each != str(root):
            each = parents[each]
        total += own if each == str(root) else 0
    return total / os.sysconf("SC_CLK_TCK")


def wire_bytes(page):
    """What has come since it was last asked: of answers that are whole, and of the stream of changes."""
    total = 0
    for entry in page.driver.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.loadingFinished":
            total += message["params"]["encodedDataLength"]
        elif message["method"] == "Network.eventSourceMessageReceived":
            total += len(message["params"]["data"])
    return total


def edited(page, script, *arguments):
    """Bytes that come, and requests for surfaces, until an edit is made, told and shown."""
    revision, requests = page.js("return [s.get('revision'), v.surfaces.numRequests]")
    wire_bytes(page)
    page.js(script, *arguments)
    page.until(f"s.get('revision') > {revision} && s.get('pending') === null && v.surfaces.isIdle && r.isResting")
    return wire_bytes(page), page.js("return v.surfaces.numRequests") - requests


POST = """
fetch("/v1/" + s.get("map").name + ":applyEdits", { method: "POST", headers: { "Content-Type": "application/json" },
  body: JSON.stringify({ edits: [arguments[0]] }) });"""


def edits(page, name):
    """A thing of middling size is moved, and cleared in half; both are undone."""
    things = page.js("""
      return [...s.get("objects").values()].filter((each) => each.kind === "thing" && each.box && r.meshOf(each.id))
        .map((each) => [each.id, r.meshOf(each.id).numTriangles, each.box.pose.translation_m])
        .sort((a, b) => a[1] - b[1])""")
    number, triangles, middle = things[3 * len(things) // 4]
    submap = f"maps/{name}/submaps/{number}"
    print(f"object {number}, {triangles} triangles:")
    size, requests = edited(page, POST, {"submap": submap, "translate": {"offset_m": {"z": 0.05}}})
    print(f"moved: {size} bytes come, {requests} requests for surfaces")
    half = {"min_m": {axis: middle[axis] - 5 for axis in "xyz"}, "max_m": {"x": middle["x"], "y": middle["y"] + 5,
                                                                          "z": middle["z"] + 5}}
    size, requests = edited(page, POST, {"submap": submap, "clear": {"box": half}})
    print(f"changed: {size} bytes come, {requests} requests for surfaces")
    undo = """
      fetch("/v1/" + s.get("map").name + ":undoEdits", { method: "POST", body: JSON.stringify({ count: 2 }),
        headers: { "Content-Type": "application/json" } });"""
    edited(page, undo)


def main(url, name):
    page = Page(url, 1280, 800 + 87)  # a window has a frame
    browser = page.driver.service.process.pid
    page.driver.get("about:blank")
    before_s = processor_s(browser)
    page.driver.get(f"{url}/ui/#map={name}&theme=dark")
    first_ms = page.driver.execute_async_script(FIRST)
    print(f"first picture: {first_ms:.0f} ms, {processor_s(browser) - before_s:.1f} s of processor in the browser")
    page.until("v.surfaces.isIdle && r.isResting && s.get('link') === 'live'")
    objects, calls, drawn, triangles, size, wire = page.js(
        "return [s.get('objects').size, r.drawCalls, r.drawnTriangles, r.numTriangles, r.meshBytes,"
        " performance.getEntriesByType('resource').reduce((sum, { transferSize }) => sum + transferSize, 0)]")
    print(f"{objects} objects, {triangles} triangles, {size / 1e6:.1f} MB of surfaces, "
          f"{wire / 1e6:.1f} MB over the wire")
    print(f"at rest: {calls} draw calls, {drawn} triangles drawn")
    page.driver.execute_async_script(TURN, 3)
    before_s = processor_s(browser)
    frames_per_s, drawn = page.driver.execute_async_script(TURN, FRAMES)
    spent_s = (processor_s(browser) - before_s) / FRAMES
    print(f"turning: {frames_per_s:.1f} frames/s, {drawn} triangles drawn, {1000 * spent_s:.0f} ms of processor a frame")
    edits(page, name)
    page.close()


if __name__ == "__main__":
    main(*sys.argv[1:3])
