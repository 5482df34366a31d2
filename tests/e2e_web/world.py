# SPDX-License-Identifier: BSD-3-Clause
"""What all cases share: a server with a map, and a page."""
from selenium.common.exceptions import WebDriverException

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


def near(a, b, tolerance=1e-6):
    return all(abs(a[axis] - b[axis]) <= tolerance for axis in "xyz")
