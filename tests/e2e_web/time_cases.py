# SPDX-License-Identifier: BSD-3-Clause
"""What the map was before, and that nobody changes it there."""
from world import MAP, near


def edit(world, text):
    return world.server.ask(f"maps/{MAP}:applyEdits", {"author": "anna", "edits": [text]})["revision"]


def undo(world, revisions):
    for revision in reversed(revisions):
        world.server.ask(f"maps/{MAP}:undoEdits", {"edit": f"maps/{MAP}/edits/{revision}", "author": "anna"})


def test_the_slider_shows_what_was_says_what_has_changed_and_a_key_leads_back(world):
    page = world.page
    name = f"maps/{MAP}/submaps/{world.sofa}"
    plant = next(key for key, each in world.server.objects(MAP).items() if each["class_name"] == "plant")
    page.fresh()
    page.keys("e")
    page.until("s.get('kept').length > 0 && document.querySelector('.timeline').checkVisibility() && r.isResting")
    before, x_before = page.place(world.sofa), world.server.translation(MAP, world.sofa)["x"]
    blue = page.pixel(*before)
    first = world.server.ask(f"maps/{MAP}")["map"]["revision"]
    revisions = [edit(world, {"submap": name, "translate": {"offset_m": {"x": 2.5}}}),
                 edit(world, {"submap": f"maps/{MAP}/submaps/{plant}", "delete": {}})]
    page.until(f"s.get('revision') >= {revisions[-1]} && !s.get('objects').has('{plant}') && v.surfaces.isIdle")
    page.until("r.isResting")
    away = page.pixel(*before)
    page.until("s.get('kept').length > 2")
    page.keys(",", ",")
    page.until(f"s.get('at') === {first} && v.surfaces.isIdle && r.isResting && r.meshOf('{plant}') !== null")
    assert page.place(world.sofa) == before, "the sofa is where it was"
    there = page.pixel(*before)
    apart = lambda a, b: sum(abs(u - w) for u, w in zip(a, b))
    assert apart(there, blue) < 12 and apart(away, blue) > 40, f"{blue} {away} {there}"
    said = page.js("return document.querySelector('.past').textContent")
    assert "moved by 2.50 m" in said and "was removed" in said, said
    page.until(f"location.hash.includes('at={first}')")
    page.js("s.set('selected', arguments[0])", world.sofa)
    page.keys("[")  # would turn it
    page.drag(*page.place(world.sofa), 50, 20)
    page.until("r.isResting")
    assert page.js("return s.get('undoable').length === 0 && s.get('pending') === null")
    assert abs(world.server.translation(MAP, world.sofa)["x"] - x_before - 2.5) < 1e-6
    page.keys("n")
    page.until(f"s.get('at') === null && !s.get('objects').has('{plant}') && v.surfaces.isIdle && r.isResting")
    assert near(page.js("return s.get('objects').get(arguments[0]).pose.translation_m", world.sofa),
                world.server.translation(MAP, world.sofa))
    page.keys("e")
    undo(world, revisions)
    page.hear()
    assert page.complaints == [], page.complaints


def test_what_is_asked_in_the_past_is_answered_of_the_past_and_the_present_goes_on_meanwhile(world):
    page = world.page
    page.fresh()
    name = f"maps/{MAP}/submaps/{world.sofa}"
    first = world.server.ask(f"maps/{MAP}")["map"]["revision"]
    revisions = [edit(world, {"submap": name, "translate": {"offset_m": {"z": 3}}})]
    page.until(f"s.get('revision') >= {revisions[0]}")
    page.keys("e", ",")
    page.until(f"s.get('at') === {first} && v.surfaces.isIdle && r.isResting")
    revisions.append(edit(world, {"submap": name, "translate": {"offset_m": {"x": 1}}}))
    page.until(f"s.get('newest') === {revisions[1]} && s.get('at') === {first}")
    page.keys("p")
    page.click(*page.place(world.sofa))
    page.until("s.get('probe') && s.get('probe').answer")
    assert page.js("return s.get('probe').answer.ownerId") == world.sofa, "there it was then"
    page.js("s.set('probe', null); s.set('tool', 'select'); s.set('selected', null);")
    page.keys("n")
    page.until(f"s.get('at') === null && s.get('revision') === {revisions[1]} && v.surfaces.isIdle")
    shown = page.js("return s.get('objects').get(arguments[0]).pose.translation_m", world.sofa)
    assert near(shown, world.server.translation(MAP, world.sofa))
    page.keys("e")
    undo(world, revisions)


def test_a_state_that_is_no_longer_kept_is_said_and_what_is_there_is_shown(world):
    page = world.page
    page.fresh()
    name = f"maps/{MAP}/submaps/{world.sofa}"
    first = world.server.ask(f"maps/{MAP}")["map"]["revision"]
    revisions = [edit(world, {"submap": name, "translate": {"offset_m": {"x": 0.5}}})]
    page.until(f"s.get('revision') >= {revisions[0]}")
    page.keys("e", ",")
    page.until(f"s.get('at') === {first}")
    world.server.kill()
    world.server.start()  # which keeps no past states of before
    revisions.append(edit(world, {"submap": name, "rename": {"display_name": "settee"}}))
    page.until(f"s.get('newest') >= {revisions[1]} && document.querySelector('.when').textContent.includes('no longer')")
    page.keys("n", "e")
    page.until(f"s.get('at') === null && s.get('objects').get('{world.sofa}').label === 'settee'")
    page.open(f"at={first}")
    page.until("s.get('toast') && s.get('toast').text.includes('not kept any longer') && s.get('at') === null")
    page.keys("e")
    undo(world, revisions)
    page.hear()
    page.complaints.clear()  # the browser tells of each try
