#!/usr/bin/env -S python3 -B
# SPDX-License-Identifier: BSD-3-Clause
"""Builds and runs tests under sanitizers, room by room. The last line reads `N passed, N failed`.

  deploy/ci/sanitizers.py [--for SECONDS] [--presets asan,tsan] [--kinds served,threaded,tool] [--fuzz SECONDS]

First come the rooms that the commits of the last 24 hours touched, then the others, each time beginning with another one.
With --for all ends after so many seconds: what is left by then is cut off and told, and is no failure. --fuzz runs each
fuzzer for so long, in the same turns.
"""
import argparse
import json
import os
import re
import signal
import subprocess
import sys
import time

import sanitizer_order

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
KIND_OF_PRESET = {"asan": ("served", "tool"), "tsan": ("threaded",)}
ENVIRONMENT = {
    "asan": {"ASAN_OPTIONS": "detect_leaks=1", "UBSAN_OPTIONS": "print_stacktrace=1"},
    # Without the list of addresses that it has told of or left out: each access to one is looked up in all of it. With the
    # longest history: a suppression cannot match a stack that is forgotten.
    "tsan": {"TSAN_OPTIONS": "halt_on_error=1:suppress_equal_addresses=0:history_size=7"
                             f":suppressions={ROOT}/deploy/tsan.supp"},
}
# Faults at each call of a single thread: nothing to race with, most of storage's time, and AddressSanitizer has run them.
EXCEPT = {"tsan": r"SqliteStoreTest\.(KilledAt|FlippedBytes)|BrokenDisk|BrokenReclaim"}
COUNTS = re.compile(r"^(\d+) passed, (\d+) failed$", re.MULTILINE)


def run_until(command, until, log=None, **options):
    """The exit code, or None where its time was over: all of its processes are killed then."""
    with open(log, "w", encoding="utf-8") if log else open(os.devnull, "w", encoding="utf-8") as out:
        process = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT, start_new_session=True, cwd=ROOT, **options)
        try:
            return process.wait(None if until is None else max(0.0, until - time.time()))
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGTERM)
            process.wait()
            return None


class Sanitizers:
    def __init__(self, options):
        self.options = options
        self.until = None if options.seconds is None else time.time() + options.seconds
        self.passed, self.failed, self.left = 0, 0, []

    def is_over(self):
        return self.until is not None and time.time() >= self.until

    def run(self):
        os.makedirs(os.path.join(ROOT, "build"), exist_ok=True)
        for preset, room in self.plan():
            if self.is_over():
                self.left.append(f"{preset} {room}")
            elif preset == "fuzz":
                self.fuzz(room)
            else:
                self.test(preset, room)

    def plan(self):
        """Pairs of a preset and a room, or of `fuzz` and a fuzzer."""
        of_preset = {preset: self.rooms(preset) for preset in self.options.presets}
        fuzzers = []
        if self.options.fuzz and "asan" in of_preset:
            fuzzers = [room["room"] for room in self.manifest("asan") if room["room"].startswith("unit/fuzz/")]
        every = list(dict.fromkeys([room for rooms in of_preset.values() for room in rooms] + fuzzers))
        planned = []
        for room in sanitizer_order.in_order(every, sanitizer_order.touched_files(), sanitizer_order.number_of_commits()):
            planned += [(preset, room) for preset, rooms in of_preset.items() if room in rooms]
            planned += [("fuzz", room)] if room in fuzzers else []
        return planned

    def rooms(self, preset):
        log = os.path.join(ROOT, "build", f"{preset}-configure.log")
        if run_until(["cmake", "--preset", preset, "-DDHPMAP_BUILD_TESTS=ON"], self.until, log) != 0:
            self.fail(f"{preset}: cannot be configured", log)
            return []
        return [room["room"] for room in self.manifest(preset)
                if any(kind in room["kinds"] for kind in KIND_OF_PRESET[preset] if kind in self.options.kinds)]

    def manifest(self, preset):
        with open(os.path.join(ROOT, "build", preset, "tests", "rooms.json"), encoding="utf-8") as file:
            return json.load(file)

    def build(self, preset, target):
        """Whether it is built; a failure is counted here, what was cut off told."""
        began, log = time.time(), os.path.join(ROOT, "build", f"{preset}-build.log")
        code = run_until(["cmake", "--build", "--preset", preset, "--target", target], self.until, log)
        if code is None:
            self.left.append(f"{preset} {target}, while it was built")
        elif code != 0:
            self.fail(f"{preset} {target}: cannot be built", log)
        else:
            print(f"-- {preset} {target}: built in {time.time() - began:.0f} s", flush=True)
        return code == 0

    def test(self, preset, room):
        manifest = os.path.join(ROOT, "build", preset, "tests", "rooms.json")
        target = next(its["target"] for its in self.manifest(preset) if its["room"] == room)
        if not self.build(preset, target):
            return
        command = [sys.executable, os.path.join(ROOT, "deploy/ci/run_rooms.py"), manifest, "--rooms", f"^{room}$",
                   "--case-limit", "1200"]
        if preset in EXCEPT:
            command += ["--except", EXCEPT[preset]]
        if self.until is not None:
            command += ["--until", str(self.until)]
        log = os.path.join(ROOT, "build", f"{preset}-test.log")
        run_until(command, None, log, env={**os.environ, **ENVIRONMENT[preset]})
        with open(log, encoding="utf-8", errors="replace") as file:
            text = file.read()
        self.count(f"{preset} {room}", text)

    def count(self, name, text):
        counts = COUNTS.findall(text)
        passed, failed = map(int, counts[-1]) if counts else (0, 1)
        self.passed += passed
        self.failed += failed
        for line in text.splitlines():
            if line.startswith("cut off: "):
                self.left.append(f"{name}: {line[len('cut off: '):]}")
        print(text if failed else f"-- {name}: {passed} passed", flush=True)

    def fuzz(self, room):
        name = room.rsplit("/", 1)[-1]
        if not self.build("asan", f"{name}_fuzz"):
            return
        corpus, findings = os.path.join(ROOT, "build/fuzz/corpus", name), os.path.join(ROOT, "build/fuzz/findings")
        seeds, log = os.path.join(ROOT, "tests/fuzz/corpus", name), os.path.join(ROOT, "build/fuzz", name + ".log")
        for folder in (corpus, findings, seeds):
            os.makedirs(folder, exist_ok=True)
        binaries = os.path.join(ROOT, "build/asan")
        code = run_until([f"{binaries}/tests/{name}_replay", "--write-seeds", corpus], self.until)
        if code == 0:
            code = run_until([f"{binaries}/fuzz/{name}_fuzz", f"-max_total_time={self.options.fuzz}", "-max_len=4096", "-timeout=60",
                              "-rss_limit_mb=2048", "-print_final_stats=1", f"-artifact_prefix={findings}/{name}-", corpus, seeds],
                             self.until, log)
        if code is None:
            self.left.append(f"fuzz {name}, while it ran")
        elif code != 0:
            self.fail(f"fuzz {name}: a finding, kept in {findings}", log)
        else:
            self.passed += 1
            print(f"-- fuzz {name}: nothing found in {self.options.fuzz} s", flush=True)

    def fail(self, what, log):
        self.failed += 1
        with open(log, encoding="utf-8", errors="replace") as file:
            print("\n".join([what] + file.read().splitlines()[-60:]), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--for", dest="seconds", type=float, help="seconds after which all is cut off")
    parser.add_argument("--presets", type=lambda text: text.split(","), default=["asan", "tsan"])
    parser.add_argument("--kinds", type=lambda text: text.split(","), default=["served", "threaded"])
    parser.add_argument("--fuzz", type=int, default=0, help="seconds that each fuzzer runs")
    sanitizers = Sanitizers(parser.parse_args())
    sanitizers.run()
    if sanitizers.left:
        print(f"{len(sanitizers.left)} cut off, as the time was over: " + "; ".join(sanitizers.left))
    print(f"{sanitizers.passed} passed, {sanitizers.failed} failed")
    return 0 if sanitizers.failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
