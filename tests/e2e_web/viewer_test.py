#!/usr/bin/python3 -B
# SPDX-License-Identifier: BSD-3-Clause
"""The viewer in a real browser: viewer_test.py PROGRAMS_DIR [CASE ...]. Pictures of cases that fail stay in /tmp."""
import colorsys
import re
import sys
import tempfile
import traceback

from selenium.common.exceptions import WebDriverException
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from browser import Page
from served_map import Server, render

MAP = "apartment"
COARSE = ["--set", "voxel_size_m=0.08", "--set", "truncation_m=0.16"]  # without a GPU each triangle takes its time


class World:
    """What all cases share: a server with a map, and a page. Each case leaves the map as it was."""

    def __init__(self, programs, folder):
        self.programs, self.folder = programs, folder
        self.data = render(programs, folder)
        self.server = Server(programs, folder)
        feeding = self.server.feed(self.data, "--map", MAP, "--labels", "groundtruth", *COARSE)
        _, error = feeding.communicate()
        assert feeding.returncode == 0, error.decode()
        self.page = Page(self.server.url)
        objects = self.server.objects(MAP).values()
        sofas = [each for each in objects if each["class_name"] == "sofa"]
        self.sofa = max(sofas, key=lambda each: each["bounding_sphere"]["radius_m"])["name"].split("/")[-1]

    def picture(self, name):
        """Of a page that may not answer any more."""
        file = f"/tmp/{name}.png"
        try:
            self.page.picture(file)
        except WebDriverException as error:
            return f"no picture: {error.msg}"
        return file

    def close(self):
        self.page.close()
        self.server.stop()


def hue_of(rgb):
    return colorsys.rgb_to_hls(*(value / 255 for value in rgb))[0]


def hues_apart(a, b):
    turn = abs(hue_of(a) - hue_of(b))
    return min(turn, 1 - turn)


def near(a, b, tolerance=1e-6):
    return all(abs(a[axis] - b[axis]) <= tolerance for axis in "xyz")


def colour_of_class(page, object_id):
    """As the list shows it."""
    text = page.js("""
      const row = document.querySelector(`.list [data-id="${arguments[0]}"]`);
      return getComputedStyle(row.closest(".class-group").querySelector(".swatch")).backgroundColor;""", object_id)
    return [float(value) for value in re.findall(r"[0-9.]+", text)[:3]]


def test_shows_the_whole_map_and_asks_nobody_else(world):
    page = world.page
    page.open("theme=dark")
    page.hear()
    assert page.complaints == [], page.complaints
    foreign = [url for url in page.requests if not url.startswith((world.server.url, "data:", "about:", "blob:"))]
    assert foreign == [], foreign
    num = len([each for each in world.server.objects(MAP).values() if "bounding_sphere" in each])
    page.until(f"document.querySelector('.panel-tools .count').textContent === '{num} objects'")
    assert page.js("return r.numTriangles") > 100_000
    meshes = [url for url in page.requests if "/mesh" in url]
    assert len(meshes) <= 2, "many surfaces come in one request"


def test_the_sofa_has_its_colour_where_it_is_and_hiding_its_class_takes_it_away(world):
    page = world.page
    page.fresh(colour="class")
    x, y = page.place(world.sofa)
    colour = colour_of_class(page, world.sofa)
    shown = page.pixel(x, y)
    assert hues_apart(shown, colour) < 0.05, f"{shown} in place of {colour}"
    page.js("document.querySelector('.class-row .eye[title=\"Hide sofa\"]').click()")
    assert hues_apart(page.pixel(x, y), colour) > 0.05 or max(page.pixel(x, y)) - min(page.pixel(x, y)) < 30
    page.until("location.hash.includes('hide=ceiling,sofa')")


def test_hovering_names_and_clicking_selects_in_scene_and_list(world):
    page = world.page
    page.fresh()
    x, y = page.place(world.sofa)
    page.point_at(x, y)
    page.until(f"s.get('hovered') === '{world.sofa}'")
    assert page.js("return document.querySelector('.label').textContent").startswith("sofa")
    page.click(x, y)
    page.until(f"s.get('selected') === '{world.sofa}' && r.selected.id === '{world.sofa}'")
    current = page.js("return document.querySelector('.list [aria-current=true]').textContent")
    assert current.startswith("sofa"), current
    assert page.js("return document.querySelector('.inspector .title').value").startswith("sofa")
    other = page.driver.find_element(By.CSS_SELECTOR, '.list [aria-current="false"]')
    page.js("arguments[0].click()", other)
    page.until(f"s.get('selected') === '{other.get_attribute('data-id')}'")


def test_a_drag_moves_by_a_matrix_alone_and_undo_takes_it_back(world):
    page = world.page
    page.fresh(world.sofa)
    before = world.server.translation(MAP, world.sofa)
    x, y = page.place(world.sofa)
    page.hear()
    page.requests.clear()
    fetched = page.js("return v.surfaces.numRequests")
    page.drag(x, y, 60, 40)
    page.until("s.get('undoable').length === 1 && s.get('pending') === null")
    moved = world.server.translation(MAP, world.sofa)
    assert not near(before, moved, 0.1), f"{before} {moved}"
    assert abs(moved["z"] - before["z"]) < 1e-9, "over the floor"
    page.until(f"s.get('objects').get('{world.sofa}').pose.translation_m.x.toFixed(4) === '{moved['x']:.4f}'")
    page.chord([Keys.CONTROL], "z")
    page.until("s.get('undoable').length === 0 && s.get('redoable').length === 1")
    assert near(world.server.translation(MAP, world.sofa), before)
    page.until(f"Math.abs(s.get('objects').get('{world.sofa}').pose.translation_m.x - {before['x']}) < 1e-6")
    assert page.js("return v.surfaces.numRequests") == fetched, "no surface was fetched"
    page.hear()
    assert page.complaints == [], page.complaints


def test_the_surface_of_what_is_moved_again_is_the_same_file(world):
    name = f"maps/{MAP}/submaps/{world.sofa}"
    revisions, etags = [], []
    for offset_m in ({"x": 0.3}, {"y": 0.2, "z": 0.1}):
        edit = {"edits": [{"submap": name, "translate": {"offset_m": offset_m}}], "author": "anna"}
        revisions.append(world.server.ask(f"maps/{MAP}:applyEdits", edit)["revision"])
        status, etag = world.server.surface(MAP, world.sofa)
        assert status == 200, status
        etags.append(etag)
    assert etags[0] == etags[1], etags
    assert world.server.surface(MAP, world.sofa, etags[0]) == (304, etags[0])
    for revision in reversed(revisions):
        world.server.ask(f"maps/{MAP}:undoEdits", {"edit": f"maps/{MAP}/edits/{revision}", "author": "anna"})


def test_what_is_dragged_turns_red_where_it_would_touch_something(world):
    page = world.page
    page.fresh(world.sofa)
    before = world.server.translation(MAP, world.sofa)
    tables = [each for each in world.server.objects(MAP).values() if each["class_name"] == "coffee table"]
    table = max(tables, key=lambda each: each["bounding_sphere"]["radius_m"])["name"].split("/")[-1]
    (x, y), (table_x, table_y) = page.place(world.sofa), page.place(table)
    page.drag(x, y, table_x - x, table_y - y, releases=False)
    page.until(f"s.get('touched').includes('{table}')")
    assert "It would touch" in page.js("return document.querySelector('.said').textContent")
    assert page.js("return r.outline.material.uniforms.selected.value.getHexString()") == "ff5a5f"
    page.keys(Keys.ESCAPE)
    page.until("s.get('pending') === null && s.get('touched').length === 0")
    page.release()
    assert near(world.server.translation(MAP, world.sofa), before), "Esc leaves it where it was"


def test_a_slice_and_a_probe_are_shown_where_they_are_asked_for(world):
    page = world.page
    page.fresh()
    page.keys("s")
    page.until("s.get('slice_m') !== null && v.slice.plane.mesh.parent !== null")
    page.keys("sp")
    page.until("s.get('slice_m') === null && s.get('tool') === 'probe'")
    x, y = page.place(world.sofa)
    page.click(x, y)
    page.until("s.get('probe') && s.get('probe').answer")
    probe = page.js("return s.get('probe')")
    assert probe["id"] == probe["answer"]["ownerId"], probe
    assert probe["answer"]["distance_m"] >= 0, probe
    page.keys(Keys.ESCAPE)
    page.until("s.get('tool') === 'select' && s.get('probe') === null")


def test_numbers_typed_in_move_and_keys_alone_find_select_and_move(world):
    page = world.page
    page.fresh()
    page.keys("/")
    page.keys("sofa", Keys.ENTER)
    page.until("s.get('selected') !== null && s.get('query') === 'sofa'")
    chosen = page.js("return s.get('selected')")
    before = world.server.translation(MAP, chosen)
    page.chord([Keys.ALT], Keys.ARROW_RIGHT)
    page.until("s.get('undoable').length === 1 && s.get('pending') === null")
    after = world.server.translation(MAP, chosen)
    assert abs(after["x"] - before["x"] - 0.05) < 1e-6, f"{before} {after}"
    page.until("document.querySelector('.pose input') && !document.querySelector('.pose input').disabled")
    field = page.driver.find_element(By.CSS_SELECTOR, ".pose input")
    target = float(field.get_attribute("value")) + 0.5
    field.send_keys(Keys.CONTROL, "a")
    field.send_keys(f"{target:.2f}".replace(".", ","), Keys.ENTER)  # as half of Europe types it
    page.until("s.get('undoable').length === 2 && s.get('pending') === null")
    assert abs(world.server.translation(MAP, chosen)["x"] - after["x"] - 0.5) < 0.011
    for left in (1, 0):
        page.chord([Keys.CONTROL], "z")
        page.until(f"s.get('undoable').length === {left}")
    assert near(world.server.translation(MAP, chosen), before)


def test_a_path_is_checked_by_clicks_and_again_when_what_is_in_its_way_is_moved(world):
    page = world.page
    page.fresh()
    name = f"maps/{MAP}/submaps/{world.sofa}"
    box = world.server.ask(name)["submap"]["oriented_box"]
    middle, size = box["pose"]["translation_m"], box["size_m"]
    reach = (size["x"] + size["y"]) / 2
    page.js("""
      s.set("tool", "path");
      s.set("path", { ...s.get("path"), points_m: [
        { x: arguments[0] - arguments[2], y: arguments[1], z: arguments[3] },
        { x: arguments[0], y: arguments[1], z: arguments[3] }] });""",
            middle["x"], middle["y"], reach, middle["z"] - size["z"] / 2)
    page.until("s.get('pathAnswer') !== null && !s.get('pathAnswer').isFree")
    assert "touches" in page.js("return document.querySelector('.path .collision').textContent")
    page.until("location.hash.includes('path=')")
    page.js("s.set('path', { ...s.get('path'), points_m: s.get('path').points_m.slice(1) })")
    page.until(f"s.get('pathAnswer') && s.get('pathAnswer').contact && s.get('pathAnswer').contact.id === '{world.sofa}'")
    revision = world.server.ask(f"maps/{MAP}:applyEdits", {"author": "anna", "edits": [
        {"submap": name, "translate": {"offset_m": {"z": 5}}}]})["revision"]
    page.until(f"s.get('pathAnswer').revision >= {revision} && (s.get('pathAnswer').contact || {{}}).id !== '{world.sofa}'")
    world.server.ask(f"maps/{MAP}:undoEdits", {"edit": f"maps/{MAP}/edits/{revision}", "author": "anna"})
    page.js("s.set('path', { ...s.get('path'), points_m: [] })")
    x, y = page.place(world.sofa)
    page.click(x, y)
    page.until("s.get('path').points_m.length === 1")
    page.js("s.set('path', { ...s.get('path'), points_m: [] })")
    page.keys(Keys.ESCAPE)
    page.until("s.get('tool') === 'select'")


def press(page, text):
    page.js("""
      const all = [...document.querySelectorAll(".inspector .button")];
      all.find((each) => each.textContent === arguments[0] && each.checkVisibility()).click();""", text)


def test_a_clone_a_merge_and_a_split_are_tried_out_made_and_undone(world):
    page = world.page
    page.fresh(world.sofa)
    objects = len(world.server.objects(MAP))
    page.until("document.querySelector('.actions') !== null")
    press(page, "Clone")
    page.until(f"s.get('selected') !== '{world.sofa}' && s.get('selected') !== null && s.get('undoable').length === 1")
    clone = page.js("return s.get('selected')")
    page.until(f"r.meshOf('{clone}') !== null")
    press(page, "Split…")
    page.until("s.get('trial') !== null")
    press(page, "By a plane")
    page.until("s.get('draft').cut.by === 'plane' && s.get('trial') && s.get('trial').isGood")
    assert len(world.server.objects(MAP)) == objects + 1, "nothing is done yet"
    press(page, "Split")
    page.until("s.get('undoable').length === 2 && s.get('draft') === null")
    assert len(world.server.objects(MAP)) == objects + 2
    part = max(world.server.objects(MAP), key=int)
    page.until(f"s.get('objects').has('{part}') && r.meshOf('{part}') !== null")
    press(page, "Merge…")
    page.js("s.set('draft', { ...s.get('draft'), other: arguments[0] })", part)
    page.until("s.get('trial') && s.get('trial').isGood")
    press(page, "Merge")
    page.until(f"s.get('undoable').length === 3 && !s.get('objects').has('{part}')")
    for left in (2, 1, 0):
        page.chord([Keys.CONTROL], "z")
        page.until(f"s.get('undoable').length === {left}")
    assert "clone of" in page.js("return s.get('toast').text")
    assert len(world.server.objects(MAP)) == objects
    page.hear()
    page.complaints = [text for text in page.complaints if "400" not in text]  # a sofa of one part


def test_while_one_turns_it_is_drawn_coarser_and_at_rest_all_of_it(world):
    page = world.page
    page.fresh()
    whole = page.js("return r.drawnTriangles")
    turning = page.driver.execute_async_script("""
      const done = arguments[arguments.length - 1], { renderer } = window.dhpmap;
      const drawn = renderer.frames.drawn;
      renderer.pace.level = 5;
      const turn = () => {
        if (renderer.frames.drawn > drawn + 3) return done(renderer.drawnTriangles);
        renderer.camera.orbit(renderer.bounds().getCenter(renderer.camera.three.position.clone()), 4, 0);
        requestAnimationFrame(turn);
      };
      turn();""")
    assert turning < min(26_000, whole), f"{turning} of {whole}"
    page.until("r.isResting")
    assert page.js("return r.drawnTriangles") > 2 * turning
    assert page.js("return r.numTriangles") > whole / 2


def test_one_walks_by_arrow_keys_at_the_height_of_the_eyes_and_comes_back(world):
    page = world.page
    page.fresh()
    before = page.js("return r.camera.view")
    page.keys("w")
    page.until("s.get('walks') && r.isResting")
    stood = page.js("return r.camera.view")
    assert abs(stood["position_m"]["z"] - 1.6) < 0.2, stood
    page.driver.execute_async_script("""
      const done = arguments[arguments.length - 1], { renderer } = window.dhpmap;
      const tell = (type) => document.dispatchEvent(new KeyboardEvent(type, { key: "ArrowUp", bubbles: true }));
      const from = renderer.camera.view.position_m;
      tell("keydown");
      const look = () => {
        const at = renderer.camera.view.position_m;
        if (Math.hypot(at.x - from.x, at.y - from.y) < 0.3) return requestAnimationFrame(look);
        tell("keyup");
        done();
      };
      look();""")
    assert abs(page.js("return r.camera.view.position_m.z") - stood["position_m"]["z"]) < 1e-6, "over the floor"
    page.keys(Keys.ESCAPE)
    page.until("!s.get('walks') && r.isResting")
    assert near(page.js("return r.camera.view.position_m"), before["position_m"])


def test_what_somebody_else_edits_meanwhile_is_not_overwritten(world):
    page = world.page
    page.fresh(world.sofa)
    x, y = page.place(world.sofa)
    page.drag(x, y, 40, 30, releases=False)
    page.until("s.get('pending') !== null")
    name = f"maps/{MAP}/submaps/{world.sofa}"
    revision = world.server.ask(f"maps/{MAP}:applyEdits", {"author": "anna", "edits": [
        {"submap": name, "translate": {"offset_m": {"x": 0.25}}}]})["revision"]
    page.until(f"s.get('revision') >= {revision}")
    page.release()
    page.until("s.get('toast') && s.get('toast').tone === 'problem' && s.get('pending') === null")
    assert "Somebody else" in page.js("return document.querySelector('.status .said').textContent")
    assert abs(world.server.translation(MAP, world.sofa)["x"] - 0.25) < 1e-6
    page.until(f"Math.abs(s.get('objects').get('{world.sofa}').pose.translation_m.x - 0.25) < 1e-6")
    world.server.ask(f"maps/{MAP}:undoEdits", {"edit": f"maps/{MAP}/edits/{revision}", "author": "anna"})
    page.hear()
    page.complaints = [text for text in page.complaints if "409" not in text]  # the one that was meant
    assert page.complaints == [], page.complaints


def test_a_map_grows_while_a_robot_feeds_it(world):
    page = world.page
    first = world.server.feed(world.data, "--map", "growing", "--labels", "groundtruth", "--frames", "6", "--no-finish")
    first.communicate()
    page.open("map=growing")
    few = page.js("return s.get('objects').size")
    triangles = page.js("return r.numTriangles")
    feeding = world.server.feed(world.data, "--map", "growing", "--labels", "groundtruth")
    page.until(f"s.get('objects').size > {few} + 20 && r.numTriangles > 1.5 * {triangles}")
    page.until("s.get('robots').length === 1 && s.get('robots')[0].path_m.length > 3")
    _, error = feeding.communicate()
    assert feeding.returncode == 0, error.decode()
    revision = world.server.ask("maps/growing")["map"]["revision"]
    page.until(f"s.get('revision') >= {revision} && v.surfaces.isIdle")
    assert page.js("return s.get('objects').size") == len(world.server.objects("growing"))
    page.hear()
    assert page.complaints == [], page.complaints


def test_a_lost_server_is_said_and_heals_to_the_right_state(world):
    page = world.page
    page.fresh()
    world.server.kill()
    page.until("s.get('link') === 'lost' && document.querySelector('.link').textContent.includes('lost')")
    assert page.js("return r.numTriangles") > 100_000, "what was seen stays"
    world.server.start()
    name = f"maps/{MAP}/submaps/{world.sofa}"
    revision = world.server.ask(f"maps/{MAP}:applyEdits", {"author": "anna", "edits": [
        {"submap": name, "translate": {"offset_m": {"y": 0.5}}}]})["revision"]
    y = f"s.get('objects').get('{world.sofa}').pose.translation_m.y"
    page.until(f"s.get('link') === 'live' && Math.abs({y} - 0.5) < 1e-6")
    world.server.ask(f"maps/{MAP}:undoEdits", {"edit": f"maps/{MAP}/edits/{revision}", "author": "anna"})
    page.hear()
    page.complaints.clear()  # the browser tells of each try


def test_at_rest_no_frame_is_drawn_and_replaced_surfaces_are_freed(world):
    page = world.page
    page.fresh()
    drawn = page.js("return r.frames.drawn")
    page.frames(30)
    assert page.js("return r.frames.drawn") == drawn
    held = page.js("return r.geometries")
    page.driver.execute_async_script("""
      const done = arguments[arguments.length - 1], { renderer, surfaces } = window.dhpmap;
      const attributes = renderer.meshOf(arguments[0]).mesh.geometry.attributes;
      const indices = renderer.meshOf(arguments[0]).mesh.geometry.index.array;
      const surface = { id: arguments[0], offset_m: [0, 0, 0], scale_m: 1, positions: attributes.position.array,
                        normals: attributes.normal.array, colors: attributes.color.array, indices, bytes: 0 };
      const isWithoutGpu = renderer.isWithoutGpu;
      renderer.isWithoutGpu = false; // or coarser surfaces of other objects are made meanwhile, and counted
      let n = 0;
      const again = () => {
        renderer.put(surface);
        if (++n < 20) return requestAnimationFrame(again);
        renderer.isWithoutGpu = isWithoutGpu;
        requestAnimationFrame(done);
      };
      again();""", world.sofa)
    assert page.js("return r.geometries") <= held, "twenty replacements leave nothing behind"


def test_a_view_is_a_link(world):
    page = world.page
    page.open(f"object={world.sofa}&colour=object&boxes=1&find=sofa&theme=light&view=1,2,9,0.5,-1.2")
    keys = "['selected', 'colour', 'showsBoxes', 'query', 'theme']"
    state = f"return {keys}.map((key) => s.get(key)).concat(r.camera.view)"
    first = page.js(state)
    assert first[:5] == [world.sofa, "object", True, "sofa", "light"], first
    page.js("s.set('showsBoxes', false)")
    page.until("!location.hash.includes('boxes')")  # the page has written it
    page.js("s.set('showsBoxes', true)")
    page.until("location.hash.includes('boxes')")
    page.open(page.js("return location.hash.slice(1)"))
    assert page.js(state) == first


def test_twice_as_large_and_narrow_everything_is_reached(world):
    page = world.page
    page.driver.set_window_size(640, 480)
    try:
        page.open(f"object={world.sofa}")
        assert page.js("return document.documentElement.scrollWidth <= innerWidth")
        assert page.js("return document.querySelector('.inspector').getBoundingClientRect().bottom <= innerHeight")
        page.keys("/")
        page.until("document.activeElement.type === 'search'")
        page.keys("sofa", Keys.ESCAPE)
        page.until("s.get('query') === ''")
    finally:
        page.driver.set_window_size(1280, 800)


def test_where_keys_are_on_it_asks_for_one_and_shows_what_the_key_may_see(world):
    locked = Server(world.programs, world.folder, "locked")
    try:
        key = locked.make_key("vera", "viewer")
        locked.stop()
        locked.start()
        page = world.page
        page.driver.get(f"{locked.url}/ui/")
        page.until("s.get('phase').is === 'locked'")
        field = page.driver.find_element(By.CSS_SELECTOR, ".login input")
        field.send_keys("dhp_nobody", Keys.ENTER)
        page.until("document.querySelector('.login [role=alert]').textContent.includes('no such key')")
        field.send_keys(key, Keys.ENTER)  # what was wrong is selected
        page.until("s.get('phase').is === 'no maps'")
        assert page.js("return document.cookie") == "", "no script sees it"
        page.driver.get("about:blank")
        page.driver.get(f"{locked.url}/ui/")
        page.until("s.get('phase').is === 'no maps'")
        page.complaints.clear()  # the browser tells of each refusal
    finally:
        locked.stop()


def test_without_maps_and_without_webgl_it_says_what_to_do(world):
    empty = Server(world.programs, world.folder, "empty")
    try:
        world.page.driver.get(f"{empty.url}/ui/")
        world.page.until("s.get('phase').is === 'no maps'")
        assert "dhpmap map" in world.page.js("return document.querySelector('.overlay').textContent")
    finally:
        empty.stop()
    world.page.driver.get(f"{world.server.url}/ui/#map=nosuch")
    world.page.until("s.get('phase').is === 'no such map'")
    assert MAP in world.page.js("return document.querySelector('.overlay').textContent"), "the ones that are there"
    blind = Page(world.server.url, arguments=["--disable-3d-apis"])
    try:
        blind.driver.get(f"{world.server.url}/ui/")
        assert "WebGL" in blind.js("return document.body.textContent")
    finally:
        blind.close()


def chromium_starts():
    """Not so in some containers: that is no fault of the viewer."""
    try:
        Page("").close()
    except WebDriverException as error:
        print(f"skipped: Chromium does not start here: {error.msg}")
        return False
    return True


def main(programs, wanted):
    if not chromium_starts():
        return 0
    cases = [(name, case) for name, case in globals().items() if name.startswith("test_")]
    cases = [(name, case) for name, case in cases if not wanted or name in wanted]
    failed = []
    with tempfile.TemporaryDirectory() as folder:
        world = World(programs, folder)
        try:
            for name, case in cases:
                try:
                    case(world)
                    print(f"ok: {name}", flush=True)
                except Exception:  # pylint: disable=broad-except
                    failed.append(name)
                    traceback.print_exc()
                    print(f"failed: {name}, see {world.picture(name)}", flush=True)
        finally:
            world.close()
    print(f"{len(cases) - len(failed)} passed, {len(failed)} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
