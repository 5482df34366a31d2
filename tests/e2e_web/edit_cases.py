# SPDX-License-Identifier: BSD-3-Clause
"""What one changes, and what becomes of it."""
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select

from world import MAP, near


def press(page, text):
    page.js("""
      const all = [...document.querySelectorAll(".inspector .button")];
      all.find((each) => each.textContent === arguments[0] && each.checkVisibility()).click();""", text)


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
    assert etags[0][:18] == etags[1][:18], f"the half that is of the bytes: {etags}"
    assert world.server.surface(MAP, world.sofa, etags[0]) == (304, etags[0])
    for revision in reversed(revisions):
        world.server.ask(f"maps/{MAP}:undoEdits", {"edit": f"maps/{MAP}/edits/{revision}", "author": "anna"})


def test_who_has_a_surface_of_before_a_restart_is_told_so(world):
    page = world.page
    page.fresh()
    status, etag = world.server.surface(MAP, world.sofa)
    assert status == 200, status
    world.server.kill()
    world.server.start()
    assert world.server.surface(MAP, world.sofa, etag) == (304, etag)
    status, _ = world.server.surface(MAP, world.sofa, etag.replace("-gzip", ""))
    assert status == 200, "that was another coding of it"
    page.until("s.get('link') === 'live'")
    page.hear()
    page.complaints.clear()  # the browser tells of each try


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
    # A sofa of one part; a surface that was asked for while its object was taken back.
    page.complaints = [text for text in page.complaints if "400" not in text and f"/{part}/mesh" not in text]


def submap(world):
    return world.server.ask(f"maps/{MAP}/submaps/{world.sofa}")["submap"]


def test_an_object_is_renamed_relabelled_and_locked_and_undo_names_each(world):
    page = world.page
    page.fresh(world.sofa)
    before = submap(world)
    page.until("document.querySelector('.class-card select') !== null")
    field = page.driver.find_element(By.CSS_SELECTOR, ".inspector .title")
    field.send_keys(Keys.CONTROL, "a")
    field.send_keys("Grandma's", Keys.ENTER)
    page.until("s.get('undoable').length === 1")
    Select(page.driver.find_element(By.CSS_SELECTOR, ".class-card select")).select_by_value("armchair")
    page.until("s.get('undoable').length === 2")
    press(page, "Lock")
    page.until(f"s.get('undoable').length === 3 && s.get('objects').get('{world.sofa}').isLocked")
    after = submap(world)
    assert (after["display_name"], after["class_name"], after["locked"]) == ("Grandma's", "armchair", True), after
    page.until("[...document.querySelectorAll('.log li')].length >= 3")
    for left, what in ((2, "lock of"), (1, "relabel of"), (0, "rename of")):
        page.chord([Keys.CONTROL], "z")
        page.until(f"s.get('undoable').length === {left} && s.get('toast') && s.get('toast').text.includes('{what}')")
    after = submap(world)
    assert all(after[key] == before[key] for key in ("display_name", "class_name", "locked")), after
    page.hear()
    assert page.complaints == [], page.complaints


def test_a_class_that_somebody_else_was_first_to_set_stays(world):
    page = world.page
    page.fresh(world.sofa)
    page.until("document.querySelector('.class-card select') !== null")
    # As if what anna does were not told yet.
    page.js("""
      const held = s.get("objects").get(arguments[0]);
      window.older = { ...held };""", world.sofa)
    revision = world.server.ask(f"maps/{MAP}:applyEdits", {"author": "anna", "edits": [
        {"submap": f"maps/{MAP}/submaps/{world.sofa}", "relabel": {"class_name": "chair"}}]})["revision"]
    page.until(f"s.get('revision') >= {revision}")
    page.js("s.set('objects', new Map([...s.get('objects'), [window.older.id, window.older]]));")
    Select(page.driver.find_element(By.CSS_SELECTOR, ".class-card select")).select_by_value("armchair")
    page.until("s.get('toast') && s.get('toast').text.includes('Somebody else')")
    assert submap(world)["class_name"] == "chair"
    page.until(f"s.get('objects').get('{world.sofa}').className === 'chair'")
    world.server.ask(f"maps/{MAP}:undoEdits", {"edit": f"maps/{MAP}/edits/{revision}", "author": "anna"})
    page.hear()
    page.complaints = [text for text in page.complaints if "409" not in text]  # the one that was meant
    assert page.complaints == [], page.complaints


def test_a_region_is_drawn_kept_clear_lifted_and_undone(world):
    page = world.page
    page.fresh()
    triangles = f"r.meshOf('{world.sofa}').numTriangles"
    before = page.js(f"return {triangles}")
    page.keys("i")
    page.until("s.get('tool') === 'region' && r.isResting")
    x, y = page.place(world.sofa)
    page.click(x - 10, y - 10)
    page.until("s.get('regionDraft') !== null")
    page.point_at(x + 40, y + 30)
    page.click(x + 40, y + 30)
    page.frames(3)
    drawn = page.js("return s.get('regionDraft').box")
    assert drawn["max_m"]["x"] - drawn["min_m"]["x"] > 0.2 and drawn["max_m"]["y"] - drawn["min_m"]["y"] > 0.1, drawn
    press(page, "Keep it clear")
    page.until("s.get('undoable').length === 1 && s.get('regions').length === 1 && s.get('regionDraft') === null")
    there = world.server.ask(f"maps/{MAP}/ignoredRegions")["ignored_regions"]
    assert abs(there[0]["box"]["min_m"]["x"] - drawn["min_m"]["x"]) < 1e-9, there
    page.until(f"v.surfaces.isIdle && {triangles} < 0.9 * {before}")  # what was there is cleared
    press(page, "Lift")
    page.until("s.get('undoable').length === 2 && s.get('regions').length === 0")
    page.chord([Keys.CONTROL], "z")
    page.until("s.get('undoable').length === 1 && s.get('regions').length === 1")
    assert "unignore region" in page.js("return s.get('toast').text")
    page.chord([Keys.CONTROL], "z")
    page.until("s.get('undoable').length === 0 && s.get('regions').length === 0")
    page.keys("i")
    page.until(f"v.surfaces.isIdle && {triangles} === {before} && r.isResting")
    page.hear()
    assert page.complaints == [], page.complaints


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
