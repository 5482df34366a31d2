#!/usr/bin/python3 -B
# SPDX-License-Identifier: BSD-3-Clause
"""What a map costs in the viewer: measure.py URL MAP. At 1280 x 800, in this machine's Chromium without a GPU.

Processor times count where other programs take the machine, too; frames a second then do not.
"""
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
    print(f"{objects} objects, {triangles} triangles, {size / 1e6:.1f} MB of surfaces, {wire / 1e6:.1f} MB over the wire")
    print(f"at rest: {calls} draw calls, {drawn} triangles drawn")
    page.driver.execute_async_script(TURN, 3)
    before_s = processor_s(browser)
    frames_per_s, drawn = page.driver.execute_async_script(TURN, FRAMES)
    spent_s = (processor_s(browser) - before_s) / FRAMES
    print(f"turning: {frames_per_s:.1f} frames/s, {drawn} triangles drawn, {1000 * spent_s:.0f} ms of processor a frame")
    page.close()


if __name__ == "__main__":
    main(*sys.argv[1:3])
