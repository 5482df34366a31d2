#!/usr/bin/python3 -B
# SPDX-License-Identifier: BSD-3-Clause
"""Runs pytest's cases of this folder as deploy/ci/run_rooms.py runs those of GoogleTest: listed, filtered and told.

  run_cases.py --bin DIR --gtest_list_tests
  run_cases.py --bin DIR [--gtest_filter=test_feed.a_case:...] [--gtest_flagfile=FILE]
"""
import argparse
import pathlib
import sys

import pytest

HERE = pathlib.Path(__file__).resolve().parent


def name_of(item):
    return f"{item.path.stem}.{item.name.removeprefix('test_')}"


class Cases:
    """A plugin of pytest."""

    def __init__(self, wanted, only_list):
        self.wanted, self.only_list, self.names, self.took_s = wanted, only_list, {}, 0.0

    def pytest_addoption(self, parser):
        parser.addoption("--verbose", default=0, help="of the terminal's plugin, which pytest's assertions look at")

    def pytest_collection_modifyitems(self, items):
        if self.wanted:
            items[:] = [item for item in items if name_of(item) in self.wanted]
        self.names = {item.nodeid: name_of(item) for item in items}

    def pytest_collection_finish(self):
        suite = None
        for name in self.names.values() if self.only_list else ():
            if name.split(".")[0] != suite:
                suite = name.split(".")[0]
                print(f"{suite}.")
            print(f"  {name.partition('.')[2]}")

    def pytest_collectreport(self, report):
        if report.failed:
            print(report.longreprtext, flush=True)

    def pytest_runtest_logstart(self, nodeid):
        self.state, self.took_s = "       OK ", 0.0
        print(f"[ RUN      ] {self.names[nodeid]}", flush=True)

    def pytest_runtest_logreport(self, report):
        self.took_s += report.duration if report.when == "call" else 0.0
        if report.failed:
            self.state = "  FAILED  "
            print(report.longreprtext, flush=True)
        elif report.skipped:
            self.state = "  SKIPPED "
            print(report.longrepr[2] if isinstance(report.longrepr, tuple) else report.longrepr, flush=True)

    def pytest_runtest_logfinish(self, nodeid):
        print(f"[{self.state}] {self.names[nodeid]} ({1000 * self.took_s:.0f} ms)", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", required=True)
    parser.add_argument("--gtest_list_tests", action="store_true")
    parser.add_argument("--gtest_filter", default="")
    parser.add_argument("--gtest_flagfile")
    parser.add_argument("--gtest_color")
    options = parser.parse_args()
    wanted = options.gtest_filter
    if options.gtest_flagfile:
        wanted = pathlib.Path(options.gtest_flagfile).read_text().strip().removeprefix("--gtest_filter=")
    arguments = [str(HERE), f"--bin={options.bin}", f"--rootdir={HERE}", "-p", "no:terminal", "-p", "no:cacheprovider",
                 "--capture=no", "-W", "error"]
    if options.gtest_list_tests:
        arguments.append("--collect-only")
    code = pytest.main(arguments, plugins=[Cases(set(wanted.split(":")) - {""}, options.gtest_list_tests)])
    return 0 if code == pytest.ExitCode.OK else 1


if __name__ == "__main__":
    sys.exit(main())
