# SPDX-License-Identifier: BSD-3-Clause
"""What one sees and finds."""
import colorsys
import re

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from world import MAP, near


def hue_of(rgb):
    return colorsys.rgb_to_hls(*(value / 255 for value in rgb))[0]


def hues_apart(a, b):
    turn = abs(hue_of(a) - hue_of(b))
    return min(turn, 1 - turn)


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
