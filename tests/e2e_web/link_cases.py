# SPDX-License-Identifier: BSD-3-Clause
"""The link to the server: live, lost, locked, and nothing there."""
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from browser import Page
from served_map import Server
from world import MAP


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
