#!/usr/bin/python3 -B
# SPDX-License-Identifier: BSD-3-Clause
"""The viewer in a real browser: viewer_test.py PROGRAMS_DIR [ROOM or CASE ...]. Pictures of cases that fail stay in /tmp."""
import sys
import tempfile
import time
import traceback

from selenium.common.exceptions import WebDriverException

import ask_cases
import edit_cases
import link_cases
import look_cases
import reach_cases
import time_cases
import tool_cases
from browser import Page
from world import World

ROOMS = (look_cases, edit_cases, ask_cases, tool_cases, time_cases, reach_cases, link_cases)


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
    cases = [(name, case) for room in ROOMS for name, case in vars(room).items()
             if name.startswith("test_") and (not wanted or name in wanted or room.__name__.removesuffix("_cases") in wanted)]
    failed = []
    with tempfile.TemporaryDirectory() as folder:
        world = World(programs, folder)
        try:
            for name, case in cases:
                began = time.monotonic()
                try:
                    case(world)
                    print(f"ok: {name}, {time.monotonic() - began:.1f} s", flush=True)
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
