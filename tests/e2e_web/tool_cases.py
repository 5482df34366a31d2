# SPDX-License-Identifier: BSD-3-Clause
"""Measure, ray, clip box, picture."""
import base64
import struct
import zlib

from selenium.webdriver.common.keys import Keys

from browser import PIXEL
from world import MAP, near


def length(a, b):
    return sum((a[axis] - b[axis]) ** 2 for axis in "xyz") ** 0.5


def test_two_clicks_measure_from_surface_to_surface_and_are_in_the_link(world):
    page = world.page
    page.fresh()
    table = next(key for key, each in world.server.objects(MAP).items() if each["class_name"] == "coffee table")
    page.keys("m")
    page.click(*page.place(world.sofa))
    page.until("s.get('measured_m').length === 1")
    page.point_at(*page.place(table))
    page.click(*page.place(table))
    page.until("s.get('measured_m').length === 2")
    ends = page.js("return s.get('measured_m')")
    for end in ends:  # where the server has a surface, too
        answer = world.server.ask(f"maps/{MAP}:queryDistances", {"points_m": [end]})["results"][0]
        assert abs(answer["distance_m"]) < 0.03, answer
    said = page.js("return document.querySelector('.tool:not([hidden]) .facts').textContent")
    assert f"Distance{length(*ends):.2f} m" in said, said
    page.until("location.hash.includes('measure=')")
    page.keys(Keys.ESCAPE)
    page.until("s.get('measured_m').length === 0 && s.get('tool') === 'select'")


def test_a_ray_meets_what_the_server_says_and_along_the_view_what_one_looks_at(world):
    page = world.page
    page.fresh()
    page.keys("d")
    page.click(*page.place(world.sofa))
    page.frames(3)
    floor = next(key for key, each in world.server.objects(MAP).items() if each["class_name"] == "floor")
    page.js("r.camera.frame(r.meshOf(arguments[0]).mesh.geometry.boundingSphere.center.clone()"
            ".applyMatrix4(r.meshOf(arguments[0]).mesh.matrixWorld), 1.5, { yaw: 1.5, pitch: -1.5 }, true)", world.sofa)
    page.js("[...document.querySelectorAll('.tool .button')].find((b) => b.textContent === 'Along the view').click()")
    page.until("s.get('ray') && s.get('ray').answer")
    ray = page.js("return s.get('ray')")
    asked = world.server.ask(f"maps/{MAP}:castRays", {
        "rays": [{"origin_m": ray["origin_m"], "direction": ray["direction"]}], "options": {"max_distance_m": 50}})
    told = asked["results"][0]
    assert near(told["point_m"], ray["answer"]["point_m"]) and ray["answer"]["id"] == told["instance_id"], told
    assert ray["answer"]["id"] != floor and ray["direction"]["z"] < -0.9, ray
    label = page.js("return s.get('objects').get(arguments[0]).label", told["instance_id"])
    assert label in page.js("return document.querySelector('.tool:not([hidden])').textContent")
    page.keys(Keys.ESCAPE)
    page.until("s.get('ray') === null && s.get('tool') === 'select'")


def test_a_clip_box_leaves_away_what_is_beyond_it_for_eyes_and_clicks_and_is_in_the_link(world):
    page = world.page
    page.fresh(world.sofa)
    page.keys("t")
    page.until("r.isResting")
    plant = max((each for each in world.server.objects(MAP).values() if each["class_name"] == "rug"),
                key=lambda each: length(each["bounding_sphere"]["center_m"],
                                        submap_of(world)["bounding_sphere"]["center_m"]))["name"].split("/")[-1]
    far, sofa = page.place(plant), page.place(world.sofa)
    shown = page.pixel(*far), page.pixel(*sofa)
    page.keys("c")
    page.until("s.get('clip') !== null && r.isResting && location.hash.includes('clip=')")
    clipped = page.pixel(*far), page.pixel(*sofa)
    apart = lambda a, b: sum(abs(u - w) for u, w in zip(a, b))
    assert apart(shown[0], clipped[0]) > 60 and apart(shown[1], clipped[1]) < 12, f"{shown} {clipped}"
    page.click(*far)
    page.until("s.get('selected') === null")
    page.click(*page.place(world.sofa))
    page.until("s.get('selected') !== null")
    page.keys("c")
    page.until("s.get('clip') === null && r.isResting && !location.hash.includes('clip=')")


def submap_of(world):
    return world.server.ask(f"maps/{MAP}/submaps/{world.sofa}")["submap"]


def test_a_picture_is_saved_as_it_is_seen_with_the_link_of_the_view_in_it(world):
    page = world.page
    page.fresh(world.sofa, colour="class")
    text = page.driver.execute_async_script("""
      const done = arguments[arguments.length - 1];
      const make = URL.createObjectURL;
      URL.createObjectURL = (blob) => {
        URL.createObjectURL = make;
        blob.arrayBuffer().then((bytes) => {
          let text = "";
          for (const byte of new Uint8Array(bytes)) text += String.fromCharCode(byte);
          done(btoa(text));
        });
        return "data:,saved";
      };
      HTMLAnchorElement.prototype.click = function () { window.saved = this.download; };
      document.querySelector('.top .button[title^="Save the picture"]').click();""")
    png = base64.b64decode(text)
    chunks, at = {}, 8
    while at < len(png):
        size, kind = struct.unpack(">I4s", png[at:at + 8])
        body = png[at + 8:at + 8 + size]
        assert struct.unpack(">I", png[at + 8 + size:at + 12 + size])[0] == zlib.crc32(kind + body), kind
        chunks[kind] = chunks.get(kind, b"") + body
        at += 12 + size
    link = chunks[b"tEXt"].decode().split("\0")[1]
    assert link.startswith(f"{world.server.url}/ui/#map={MAP}") and f"object={world.sofa}" in link, link
    width, height = struct.unpack(">II", chunks[b"IHDR"][:8])
    assert (width, height) == tuple(page.js("return [r.canvas.width, r.canvas.height + 28 * devicePixelRatio]"))
    assert page.js("return window.saved").startswith(f"{MAP}-r")
    box = page.js("const b = r.canvas.getBoundingClientRect(); return [b.left, b.top]")
    x, y = page.place(world.sofa)
    page.frames(2)
    seen = page.pixel(x, y)
    saved = page.driver.execute_async_script(PIXEL, text, x - box[0], y - box[1])
    assert sum(abs(a - b) for a, b in zip(seen, saved)) < 12, f"{seen} {saved}"
