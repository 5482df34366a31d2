#!/usr/bin/env -S python3 -B
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the tests of a build. The last line reads `N passed, N failed`.

  deploy/ci/run_rooms.py MANIFEST [--rooms REGEX] [--except REGEX] [--jobs N] [--case-limit S] [--until TIME]

Portions of a room's cases run side by side. Cases that look at a clock (their suite's name ends in `Clock`) run alone, and last.
A case that failed is run once more by itself if it looks at a clock, and so are at most two others: what passes then is
told as unstable and is no failure. What a sanitizer reported is never run again, unless ThreadSanitizer has forgotten one of the
stacks: then no suppression could match. A crash costs the case in which it came; the others go on in another process. What is left at TIME (seconds since 1970) is cut off, told, and neither passed nor failed.
"""
import argparse
import concurrent.futures
import os
import re
import sys
import time

from portion_run import FAILED, NOT_RUN, PASSED, SKIPPED, PortionRun
from rooms import Portion, looks_at_a_clock, portions, read_manifest

MOST_OTHERS_AGAIN = 2
MOST_LINES_OF_A_CASE = 200
SLOWEST = 10


class Results:
    """How the cases of all rooms ended; a name is `room/Suite.Case`."""

    def __init__(self):
        self.state, self.took_s, self.reported, self.unstable = {}, {}, set(), []

    def add(self, room, outcome):
        for case, state in outcome.state.items():
            name = full_name(room, case)
            if state != NOT_RUN:
                self.state[name] = state
                self.took_s[name] = outcome.took_s.get(case, 0)
        for where in outcome.reports:
            self.reported.add(full_name(room, where))
        if outcome.failed_outside():
            self.state[f"{room.name} (outside of its cases)"] = FAILED

    def named(self, state):
        return sorted(name for name, its in self.state.items() if its == state)


def full_name(room, case):
    return case if case == room.name else f"{room.name}/{case}"


class Runner:
    def __init__(self, options):
        self.options, self.results, self.left, self.failures = options, Results(), {}, []

    def plan(self, rooms):
        """Portions that may run side by side, the costliest rooms first, and those that run alone."""
        together, alone = [], []
        for room in sorted(rooms, key=lambda its: -its.cost_s):
            try:
                cases = [case for case in room.cases() if not self.options.without.search(case)]
            except Exception as error:  # a binary that is missing or crashes: a failure of its room, and no end of the others
                print(f"{room.name}: cannot list its cases: {error}")
                self.results.state[room.name] = FAILED
                continue
            if not cases:
                print(f"{room.name}: has no case")
                self.results.state[room.name] = FAILED
            together += portions(room, [case for case in cases if not looks_at_a_clock(case)])
            alone += portions(room, [case for case in cases if looks_at_a_clock(case)])
        return together, alone

    def run(self, rooms):
        together, alone = self.plan(rooms)
        self.total, self.done = len(together) + len(alone), 0
        for jobs, planned in ((self.options.jobs, together), (1, alone)):
            with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
                for _ in pool.map(self.run_portion, planned):
                    pass
        self.run_again()

    def run_portion(self, portion):
        cases, seen_s, counts = portion.cases, time.monotonic(), {}
        while cases:
            if self.options.until is not None and time.time() >= self.options.until:
                self.leave(portion.room, cases)
                break
            outcome = PortionRun(Portion(portion.room, cases), self.options.case_limit, self.options.until).run()
            self.results.add(portion.room, outcome)
            self.failures += told(portion.room, outcome)
            for state in outcome.state.values():
                counts[state] = counts.get(state, 0) + 1
            cases = self.rest(portion.room, cases, outcome)
        self.done += 1
        print(f"[{self.done:3}/{self.total}] {portion.room.name}: {counts.get(PASSED, 0)} passed"
              + "".join(f", {counts[state]} {state}" for state in (FAILED, SKIPPED) if state in counts)
              + f", {time.monotonic() - seen_s:.1f} s", flush=True)

    def rest(self, room, cases, outcome):
        """What a crash has left, to be run in another process; a process that began none of them would not do so then."""
        left = outcome.not_run()
        if outcome.was_cut_off:
            self.leave(room, left)
            return []
        if len(left) < len(cases):
            return left
        for case in left:
            self.results.state[full_name(room, case)] = FAILED
        return []

    def leave(self, room, cases):
        self.left[room.name] = self.left.get(room.name, 0) + len(cases)

    def run_again(self):
        """Of what failed without a sanitizer's report: all that look at a clock, and two others."""
        others = MOST_OTHERS_AGAIN
        for room, case in list(self.failures):
            name = full_name(room, case)
            if name in self.results.reported or self.results.state.get(name) != FAILED:
                continue
            if not looks_at_a_clock(case):
                others -= 1
                if others < 0:
                    continue
            outcome = PortionRun(Portion(room, [case]), self.options.case_limit, self.options.until).run()
            if outcome.exit_code == 0 and outcome.state[case] == PASSED and not outcome.reports:
                self.results.state[name] = PASSED
                self.results.unstable.append(name)


def told(room, outcome):
    """Prints what the cases that failed wrote; returns them."""
    failed = [case for case, state in outcome.state.items() if state == FAILED]
    for case in failed:
        words = outcome.words.get(case, [])
        print("\n".join([f"-- {full_name(room, case)} failed:"] + words[-MOST_LINES_OF_A_CASE:]))
    if outcome.failed_outside() or (failed and outcome.reports):
        print("\n".join([f"-- {room.name}, outside of its cases (exit {outcome.exit_code}):"]
                        + outcome.outside[-MOST_LINES_OF_A_CASE:]))
    return [(room, case) for case in failed]


def summarize(runner):
    results = runner.results
    slowest = sorted(results.took_s.items(), key=lambda its: -its[1])[:SLOWEST]
    print("slowest: " + ", ".join(f"{name} {took_s:.1f} s" for name, took_s in slowest))
    for title, names in (("skipped", results.named(SKIPPED)), ("unstable: failed, and passed by itself", results.unstable),
                         ("failed", results.named(FAILED))):
        if names:
            print(f"{len(names)} {title}:")
            print("\n".join("  " + name for name in names))
    for room, count in sorted(runner.left.items()):
        print(f"cut off: {count} cases of {room}")
    passed, failed = len(results.named(PASSED)), len(results.named(FAILED))
    print(f"{passed} passed, {failed} failed")
    return 0 if failed == 0 else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("manifest")
    parser.add_argument("--rooms", default="", help="those whose names a regular expression matches")
    parser.add_argument("--except", dest="without", type=re.compile, default=re.compile("(?!)"), metavar="REGEX",
                        help="without cases in whose names a regular expression is found")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--case-limit", type=float, default=600, help="seconds that a case may take")
    parser.add_argument("--until", type=float, help="when to cut off, in seconds since 1970")
    options = parser.parse_args()
    rooms = [room for room in read_manifest(options.manifest) if re.search(options.rooms, room.name)]
    if not rooms:
        print("there is no room to test\n0 passed, 1 failed")
        return 1
    runner = Runner(options)
    runner.run(rooms)
    return summarize(runner)


if __name__ == "__main__":
    sys.exit(main())
