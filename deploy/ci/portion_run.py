# SPDX-License-Identifier: BSD-3-Clause
"""Runs cases of one room in one process, and tells of each how it ended, also where the process crashed."""
import os
import queue
import re
import signal
import subprocess
import tempfile
import threading
import time
from dataclasses import dataclass, field

PASSED, FAILED, SKIPPED, NOT_RUN = "passed", "failed", "skipped", "not run"
REPORT_OF_A_SANITIZER = re.compile(r"ERROR: (Address|Leak|UndefinedBehavior)Sanitizer|WARNING: ThreadSanitizer|: runtime error: ")
# ThreadSanitizer has forgotten one of the two stacks, so that no suppression could match it.
UNDECIDED = "[failed to restore the stack]"
BEGINS = re.compile(r"\[ RUN      \] (\S+)$")
ENDS = re.compile(r"\[(       OK |  FAILED  |  SKIPPED )\] (\S+?)(?:, where .*)? \((\d+) ms\)$")
OF_ENDS = {"       OK ": PASSED, "  FAILED  ": FAILED, "  SKIPPED ": SKIPPED}
STRAGGLERS_S = 5  # for which a process that has ended may leave its output open, in the hands of one that it has started


@dataclass
class Outcome:
    """Of a case `state`, `words` (the lines it wrote) and `took_s`; `reports` names where a sanitizer reported."""
    state: dict = field(default_factory=dict)
    words: dict = field(default_factory=dict)
    took_s: dict = field(default_factory=dict)
    reports: list = field(default_factory=list)
    outside: list = field(default_factory=list)  # what was written between cases
    exit_code: int = 0
    was_cut_off: bool = False

    def not_run(self):
        return [case for case, state in self.state.items() if state == NOT_RUN]

    def failed_outside(self):
        """Whether the process failed although no case did: by a leak that is seen at its end, for example."""
        return self.exit_code != 0 and not self.was_cut_off and FAILED not in self.state.values()


class PortionRun:
    def __init__(self, portion, case_limit_s, until=None):
        """A case that takes longer than `case_limit_s` fails; at the time `until` (of time.time()) all is cut off."""
        self.room, self.case_limit_s, self.until = portion.room, case_limit_s, until
        self.outcome = Outcome(state={case: NOT_RUN for case in portion.cases})
        self.running = None if portion.room.is_gtest else portion.cases[0]
        self.began = 0.0
        self.lines = queue.Queue()

    def run(self):
        with tempfile.NamedTemporaryFile("w", prefix="dhpmap-cases-") as flags:
            command = list(self.room.command)
            if self.room.is_gtest:
                flags.write("--gtest_filter=" + ":".join(self.outcome.state) + "\n")
                flags.flush()
                command += ["--gtest_flagfile=" + flags.name, "--gtest_color=no"]
            self.process = subprocess.Popen(command, env={**os.environ, **self.room.environment}, stdin=subprocess.DEVNULL,
                                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
            threading.Thread(target=self._read, daemon=True).start()
            self.began = time.monotonic()
            while self._take(self._next_line()):
                pass
            self.outcome.exit_code = self.process.wait()
            self._conclude()
        return self.outcome

    def _read(self):
        def read_on():
            for line in self.process.stdout:
                self.lines.put(line.decode("utf-8", "replace").rstrip("\n"))
        reader = threading.Thread(target=read_on, daemon=True)
        reader.start()
        self.process.wait()
        reader.join(STRAGGLERS_S)
        self.lines.put(None)

    def _next_line(self):
        """None at the end, which may be that of its time."""
        left_s = self.began + self.case_limit_s - time.monotonic()
        if self.until is not None:
            left_s = min(left_s, self.until - time.time())
        try:
            return self.lines.get(timeout=max(0.0, left_s))
        except queue.Empty:
            os.killpg(self.process.pid, signal.SIGKILL)
        self.outcome.was_cut_off = self.until is not None and time.time() >= self.until
        if not self.outcome.was_cut_off:
            self._say(f"killed: it took longer than {self.case_limit_s:g} s")
        return None

    def _take(self, line):
        if line is None:
            return False
        begins, ends = BEGINS.search(line), ENDS.search(line)
        if begins and begins.group(1) in self.outcome.state:
            self.running, self.began = begins.group(1), time.monotonic()
        elif ends and self.room.is_gtest and ends.group(2) == self.running:
            self._end(OF_ENDS[ends.group(1)], int(ends.group(3)) / 1000)
            self.running = None
        else:
            if REPORT_OF_A_SANITIZER.search(line):
                self.outcome.reports.append(self.running or self.room.name)
            elif UNDECIDED in line and self.outcome.reports:
                self.outcome.reports.pop()
            self._say(line)
        return True

    def _say(self, line):
        if self.running is None:
            self.outcome.outside.append(line)
        else:
            self.outcome.words.setdefault(self.running, []).append(line)

    def _end(self, state, took_s):
        self.outcome.state[self.running] = state
        self.outcome.took_s[self.running] = took_s
        self.began = time.monotonic()

    def _conclude(self):
        if self.running is None or self.outcome.was_cut_off:
            return
        if self.room.is_gtest:
            self._say(f"the process ended in this case, with {self.outcome.exit_code}")
            self._end(FAILED, 0)
        else:
            self._end(PASSED if self.outcome.exit_code == 0 else FAILED, time.monotonic() - self.began)
