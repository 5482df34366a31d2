# SPDX-License-Identifier: BSD-3-Clause
"""What one asks: slices, points, a robot's path."""
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select

from world import MAP


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


def test_which_chairs_are_nearest_to_where_one_clicks_is_what_the_server_says(world):
    page = world.page
    page.fresh()
    page.click(*page.place(world.sofa))
    page.until(f"s.get('selected') === '{world.sofa}' && document.querySelector('.inspector .button') !== null")
    page.js("""
      [...document.querySelectorAll('.inspector .button')].find((b) => b.textContent === 'What is nearest?').click();""")
    page.until("s.get('near') !== null && document.querySelector('.near select') !== null")
    Select(page.driver.find_element(By.CSS_SELECTOR, ".near select")).select_by_value("chair")
    page.until("s.get('near').className === 'chair'")
    told = world.server.ask(f"maps/{MAP}/submaps:search", {
        "near_point_m": page.js("return s.get('clicked').point_m"), "options": {"class_names": ["chair"]}})["matches"]
    chairs = page.js("return s.get('near').objects")
    assert [each["id"] for each in chairs] == [each["submap"]["instance_id"] for each in told[:len(chairs)]], chairs
    assert len(chairs) > 1 and abs(chairs[0]["distance_m"] - told[0]["distance_m"]) < 1e-6, chairs
    page.until(f"document.querySelector('.near .log').textContent.includes('{told[0]['distance_m']:.2f} m')")
    page.js("s.set('asksNear', false); s.set('nearClass', '')")
