# SPDX-License-Identifier: BSD-3-Clause
"""What there is to run: rooms of tests, as CMake lists them, and portions of a room's cases.

A manifest (build/PRESET/tests/rooms.json) holds one object a room: `room`, `command` (a list), `is_gtest`, `cost_s`,
`environment`. A program without GoogleTest is one case, named after its room.
"""
import json
import os
import subprocess
from dataclasses import dataclass, field

MOST_CASES_OF_A_PORTION = 48


@dataclass
class Room:
    name: str
    command: list
    is_gtest: bool
    cost_s: float = 0.0
    environment: dict = field(default_factory=dict)

    def cases(self):
        """Names as `Suite.Case`, in the order of the binary. Raises OSError or CalledProcessError."""
        if not self.is_gtest:
            return [self.name]
        listed = subprocess.run(self.command + ["--gtest_list_tests"], env={**os.environ, **self.environment}, timeout=120,
                                check=True, capture_output=True, text=True)
        return parse_list(listed.stdout)


@dataclass
class Portion:
    """Cases of one room that one process runs."""
    room: Room
    cases: list


def read_manifest(path):
    with open(path, encoding="utf-8") as file:
        return [Room(entry["room"], entry["command"], entry["is_gtest"], entry.get("cost_s", 0),
                     dict(pair.split("=", 1) for pair in entry.get("environment", []))) for entry in json.load(file)]


def parse_list(text):
    """The cases that --gtest_list_tests has printed; those that are disabled are none."""
    cases, suite = [], ""
    for line in text.splitlines():
        name = line.split("#")[0].strip()
        if line and not line[0].isspace() and name.endswith("."):
            suite = name
        elif line.startswith("  ") and name and "DISABLED_" not in suite + name:
            cases.append(suite + name)
    return cases


def suite_of(case):
    return case.split(".")[0]


def looks_at_a_clock(case):
    """Whether the case is about time itself, which its suite's name ends in: it runs alone, and last."""
    return any(part.endswith("Clock") for part in suite_of(case).split("/"))


def portions(room, cases, most=MOST_CASES_OF_A_PORTION):
    """Suites of a room together, as fixtures of a suite are made once, up to so many cases; a long suite in several."""
    made, of_one_suite = [], []
    for case in cases:
        if of_one_suite and suite_of(of_one_suite[-1][0]) == suite_of(case) and len(of_one_suite[-1]) < most:
            of_one_suite[-1].append(case)
        else:
            of_one_suite.append([case])
    for run in of_one_suite:
        if made and len(made[-1].cases) + len(run) <= most:
            made[-1].cases.extend(run)
        else:
            made.append(Portion(room, list(run)))
    return made
