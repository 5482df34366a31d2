# SPDX-License-Identifier: BSD-3-Clause
"""Whoever comes, however they see and point: large, narrow, dark, light, by fingers, by keys alone."""
from selenium.webdriver.common.keys import Keys

from world import MAP

# Of all texts of panels that are shown: how much lighter one is than what is behind it (WCAG 2.2, 1.4.3), the least.
CONTRAST = """
const numbers = (css) => (css.match(/[0-9.]+/g) || []).map(Number);
const light = (css) => {
  const [r, g, b] = numbers(css).map((v) => v / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
};
const behind = (e) => {
  for (; e; e = e.parentElement) {
    const css = getComputedStyle(e).backgroundColor;
    if (css.startsWith("rgb(")) return css;
  }
  return getComputedStyle(document.body).backgroundColor;
};
const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
let worst = [99, ""];
while (texts.nextNode()) {
  const e = texts.currentNode.parentElement;
  const isOff = e.closest(":disabled, script, style, option") || !e.checkVisibility() || !texts.currentNode.data.trim();
  if (isOff || !getComputedStyle(e).color.startsWith("rgb(")) continue;
  const [a, b] = [light(getComputedStyle(e).color), light(behind(e))];
  const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  if (ratio < worst[0]) worst = [ratio, e.className + ": " + texts.currentNode.data];
}
return worst;"""


def test_dark_and_light_every_text_stands_out_and_the_scene_is_of_that_light(world):
    page = world.page
    page.fresh(world.sofa)
    grounds = []
    for theme in ("dark", "light"):
        page.js("s.set('theme', arguments[0]); s.set('showsTime', true); s.set('tool', 'region')", theme)
        page.until("r.isResting && document.querySelector('.inspector').checkVisibility()")
        page.frames(20)  # colours of buttons change softly
        ratio, text = page.js(CONTRAST)
        assert ratio >= 4.5, f"{theme}: {ratio:.2f}, {text}"
        left, top = page.js("const b = r.canvas.getBoundingClientRect(); return [b.left, b.top]")
        grounds.append(page.pixel(int(left) + 300, int(top) + 12))
    assert max(grounds[0]) < 60 < 180 < min(grounds[1]), grounds
    page.js("s.set('theme', 'system'); s.set('showsTime', false); s.set('tool', 'select')")


def touch(page, kind, *points):
    page.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {
        "type": kind, "touchPoints": [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]})


def test_by_fingers_one_selects_turns_and_comes_nearer(world):
    page = world.page
    page.fresh()
    page.driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True, "maxTouchPoints": 2})
    try:
        x, y = page.place(world.sofa)
        touch(page, "touchStart", (x, y))
        touch(page, "touchEnd")
        page.until(f"s.get('selected') === '{world.sofa}'")
        page.js("s.set('selected', null)")
        page.until("r.isResting")
        before = page.js("return r.camera.view")
        touch(page, "touchStart", (x, y))
        for step in range(1, 6):
            touch(page, "touchMove", (x + 12 * step, y))
        touch(page, "touchEnd")
        page.until(f"Math.abs(r.camera.view.yaw - {before['yaw']}) > 0.1 && r.isResting")
        far = page.js("return r.camera.view.position_m.z")
        touch(page, "touchStart", (x - 30, y), (x + 30, y))
        for step in range(1, 6):
            touch(page, "touchMove", (x - 30 - 12 * step, y), (x + 30 + 12 * step, y))
        touch(page, "touchEnd")
        page.until(f"r.camera.view.position_m.z < 0.8 * {far} && r.isResting")
    finally:
        page.driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": False})


def test_by_keys_alone_one_keeps_a_region_clear_and_sees_what_was(world):
    page = world.page
    page.fresh()
    page.keys("/", "sofa", Keys.ENTER)  # as fast as keys come
    page.until("s.get('selected') !== null && s.get('objects').get(s.get('selected')).className === 'sofa'")
    page.keys("i")
    page.until("s.get('tool') === 'region'")

    def tab_to(text):
        for _ in range(80):
            page.keys(Keys.TAB)
            if page.js("return document.activeElement.textContent") == text:
                return page.js("return getComputedStyle(document.activeElement).outlineStyle")
        raise AssertionError(f"no way to {text}")

    assert tab_to("Around the selection") != "none", "one sees where one is"
    page.keys(Keys.ENTER)
    page.until("s.get('regionDraft') !== null")
    tab_to("Keep it clear")
    page.keys(Keys.ENTER)
    page.until("s.get('undoable').length === 1 && s.get('regions').length === 1")
    page.js("document.activeElement.blur()")
    page.keys(",")
    page.until("s.get('at') !== null && s.get('showsTime')")
    page.keys("n")
    page.until("s.get('at') === null")
    page.chord([Keys.CONTROL], "z")
    page.until("s.get('undoable').length === 0 && v.surfaces.isIdle && r.isResting")
    assert "ignored_regions" not in world.server.ask(f"maps/{MAP}/ignoredRegions") or \
        not world.server.ask(f"maps/{MAP}/ignoredRegions")["ignored_regions"]
    page.js("s.set('tool', 'select')")


def test_twice_as_large_and_narrow_every_tool_and_the_time_are_reached(world):
    page = world.page
    page.driver.set_window_size(640, 480)
    try:
        page.open(f"object={world.sofa}")
        page.js("s.set('showsTime', true)")
        for tool in ("ray", "measure", "path", "region"):
            page.js("s.set('tool', arguments[0])", tool)
            page.frames(3)
            outside = page.js("""
              const boxes = ["inspector", "timeline", "status"].map((name) =>
                document.querySelector("." + name).getBoundingClientRect());
              return boxes.filter((box) => box.right > innerWidth + 1 || box.bottom > innerHeight + 1).length;""")
            assert outside == 0, tool
            assert page.js("return document.documentElement.scrollWidth <= innerWidth"), tool
        help_ = page.driver.find_element("css selector", ".top [aria-label^='Keys']")
        help_.click()  # scrolls there
        page.until("document.querySelector('dialog').open")
        page.keys(Keys.ESCAPE)
        page.until("!s.get('showsHelp')")
    finally:
        page.js("s.set('tool', 'select'); s.set('showsTime', false)")
        page.driver.set_window_size(960, 640)
