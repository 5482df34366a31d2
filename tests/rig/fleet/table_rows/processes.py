# SPDX-License-Identifier: BSD-3-Clause
"""Programs of a build, servers, and what processes have used."""
import os
import pathlib
import re
import signal
import subprocess
import time

TICKS = os.sysconf("SC_CLK_TCK")
START_S, STOP_S = 60, 60


def run(program, *arguments, timeout_s=600):
    """What it printed. RuntimeError with that if it failed."""
    done = subprocess.run([program, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          timeout=timeout_s, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{pathlib.Path(program).name}: exit code {done.returncode}\n{done.stdout}")
    return done.stdout


def numbers(pattern, text):
    """The groups of the pattern where it first matches, as numbers."""
    found = re.search(pattern, text)
    if not found:
        raise RuntimeError(f"no '{pattern}' in:\n{text}")
    return [float(its) for its in found.groups()]


class Server:
    """dhpmap-server on free ports of this machine. Use it as a context."""

    def __init__(self, bin_dir, db, folder, *arguments):
        self._command = [pathlib.Path(bin_dir) / "dhpmap-server", "--db", str(db), "--grpc", "127.0.0.1:0", "--http",
                         "127.0.0.1:0", *arguments]
        self._folder = pathlib.Path(folder)
        self.grpc = self.http = None
        self.started_s = 0  # from its start until it serves

    def __enter__(self):
        begin = time.monotonic()
        self._out = self._folder / f"server-{begin}.out"
        with open(self._out, "w", encoding="utf-8") as out:
            self._process = subprocess.Popen(self._command, stdin=subprocess.DEVNULL, stdout=out, stderr=out)
        while True:
            found = re.search(r"gRPC on ([0-9.:]+), REST on (http://[0-9.:]+)\n", self._out.read_text())
            if found:
                break
            if self._process.poll() is not None or time.monotonic() > begin + START_S:
                self.__exit__()
                raise RuntimeError("a server does not start: " + self._out.read_text())
            time.sleep(0.005)
        self.started_s = time.monotonic() - begin
        self.grpc, self.http = found.groups()
        return self

    def __exit__(self, *_):
        if self._process.poll() is not None:
            return
        self._process.send_signal(signal.SIGTERM)
        try:
            self._process.wait(STOP_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    @property
    def pid(self):
        return self._process.pid


def _stat(pid):
    with open(f"/proc/{pid}/stat", encoding="utf-8") as stat:
        return stat.read().rsplit(")", 1)[1].split()


def cpu_s(pid):
    """User and system time of a process."""
    return sum(int(its) for its in _stat(pid)[11:13]) / TICKS


def cpu_with_children_s(pid):
    """The same with its children, those that have ended, too."""
    total_s = sum(int(its) for its in _stat(pid)[11:15]) / TICKS
    for child in filter(str.isdigit, os.listdir("/proc")):
        try:
            stat = _stat(child)
        except OSError:
            continue
        if int(stat[1]) == pid:
            total_s += sum(int(its) for its in stat[11:13]) / TICKS
    return total_s


def machine_cpu_s():
    """Busy time and all time of all cores."""
    with open("/proc/stat", encoding="utf-8") as stat:
        times = [int(its) / TICKS for its in stat.readline().split()[1:9]]
    return sum(times) - times[3] - times[4], sum(times)
