# SPDX-License-Identifier: BSD-3-Clause
"""Chromium without a window, on the viewer of a server."""
import base64
import json

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains

PATIENCE_S = 150  # without a GPU, on a slow and busy machine

# Calls back once the condition, an expression of `s` (the viewer's store), `r` (its renderer) and `v`, is true.
UNTIL = """
const done = arguments[arguments.length - 1];
const look = () => {
  const v = window.dhpmap, s = v && v.store, r = v && v.renderer;
  let is = false;
  try { is = %s; } catch (error) { is = false; }
  if (is) done(true); else requestAnimationFrame(look);
};
look();"""

# Where the middle of an object's surface is on the page.
PLACE = """
const { store, renderer } = window.dhpmap;
const { mesh } = renderer.meshOf(arguments[0]);
mesh.updateMatrixWorld(true);
const p = mesh.geometry.boundingSphere.center.clone().applyMatrix4(mesh.matrixWorld).project(renderer.camera.three);
const box = renderer.canvas.getBoundingClientRect();
return [Math.round(box.left + (p.x + 1) / 2 * box.width), Math.round(box.top + (1 - p.y) / 2 * box.height)];"""

# The mean colour around a place of a screenshot.
PIXEL = """
const [png, x, y, done] = arguments;
const image = new Image();
image.onload = () => {
  const canvas = document.createElement("canvas");
  canvas.width = image.width;
  canvas.height = image.height;
  const pen = canvas.getContext("2d");
  pen.drawImage(image, 0, 0);
  const { data } = pen.getImageData(x - 2, y - 2, 5, 5);
  done([0, 1, 2].map((k) => [...data].filter((_, i) => i % 4 === k).reduce((sum, value) => sum + value, 0) / 25));
};
image.src = "data:image/png;base64," + png;"""


class Page:
    """One browser with one page."""

    def __init__(self, url, width=960, height=640, arguments=()):
        options = Options()
        options.binary_location = "/usr/bin/chromium"
        for argument in ["--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                         "--disable-dev-shm-usage", f"--window-size={width},{height}", *arguments]:
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.url = url
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        self.driver.set_script_timeout(PATIENCE_S)
        self.complaints = []
        self.requests = []

    def open(self, link=""):
        """The viewer with the view of `link`, once it shows the map whole."""
        self.driver.get("about:blank")
        self.driver.get(f"{self.url}/ui/#{link}")
        self.until("s.get('phase').is === 'ready' && v.surfaces.isIdle && s.get('link') === 'live' && r.isResting")

    def fresh(self, selected=None, colour="sensor"):
        """The view as at first, without loading the map again."""
        if not self.driver.current_url.startswith(self.url) or "map=growing" in self.driver.current_url:
            return self.open(f"colour={colour}" + (f"&object={selected}" if selected else ""))
        self.js("""
          s.set("query", ""); s.set("selected", arguments[0]); s.set("colour", arguments[1]);
          s.set("hiddenClasses", new Set(["ceiling"])); s.set("hiddenObjects", new Set());
          s.set("showsTime", false); s.set("tool", "select");
          s.set("toast", null); s.set("undoable", []); s.set("redoable", []); s.set("showsBoxes", false);
          document.activeElement.blur();""", selected, colour)
        self.keys("n", "h")
        self.until("s.get('at') === null && v.surfaces.isIdle && r.isResting && s.get('link') === 'live'")

    def until(self, condition):
        self.driver.execute_async_script(UNTIL % condition)

    def frames(self, number):
        """Lets so many frames of the browser pass."""
        self.driver.execute_async_script(
            "let n = 0; const [most, done] = arguments;"
            "const count = () => ++n > most ? done() : requestAnimationFrame(count);"
            "count();", number)

    def js(self, script, *arguments):
        names = "const v = window.dhpmap, s = v && v.store, r = v && v.renderer;"
        return self.driver.execute_script(names + script, *arguments)

    def place(self, object_id):
        return self.js(PLACE, object_id)

    def pixel(self, x, y):
        self.frames(2)
        return self.driver.execute_async_script(PIXEL, self.driver.get_screenshot_as_base64(), x, y)

    def click(self, x, y):
        actions = ActionChains(self.driver)
        actions.w3c_actions.pointer_action.move_to_location(x, y).click()
        actions.perform()

    def point_at(self, x, y):
        actions = ActionChains(self.driver)
        actions.w3c_actions.pointer_action.move_to_location(x, y)
        actions.perform()

    def drag(self, x, y, dx, dy, releases=True):
        actions = ActionChains(self.driver, duration=20)
        pointer = actions.w3c_actions.pointer_action
        pointer.move_to_location(x, y).pointer_down()
        for step in range(1, 7):
            pointer.move_to_location(round(x + dx * step / 6), round(y + dy * step / 6))
        if releases:
            pointer.pointer_up()
        actions.perform()

    def release(self):
        actions = ActionChains(self.driver)
        actions.w3c_actions.pointer_action.pointer_up()
        actions.perform()

    def keys(self, *keys):
        ActionChains(self.driver).send_keys(*keys).perform()

    def chord(self, held, key):
        actions = ActionChains(self.driver)
        for each in held:
            actions.key_down(each)
        actions.send_keys(key)
        for each in reversed(held):
            actions.key_up(each)
        actions.perform()

    def hear(self):
        """Notes what the console and the network have said since."""
        for entry in self.driver.get_log("browser"):
            if entry["level"] in ("SEVERE", "WARNING"):
                self.complaints.append(entry["message"])
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                self.requests.append(message["params"]["request"]["url"])
            elif message["method"] == "Network.responseReceived" and message["params"]["response"]["status"] >= 400:
                response = message["params"]["response"]
                self.complaints.append(f"{response['status']} {response['url']}")

    def picture(self, path):
        with open(path, "wb") as file:
            file.write(base64.b64decode(self.driver.get_screenshot_as_base64()))

    def close(self):
        self.driver.quit()
