# SPDX-License-Identifier: BSD-3-Clause
"""Paced robots on one, two and four processes: frames/s, and CPU and statements a frame."""
import contextlib
import re
import statistics
import subprocess
import time
import typing

from .database import Database
from .processes import Server, cpu_s, cpu_with_children_s, machine_cpu_s
from .row import Row

RATE_HZ = 1.5  # of each robot
IDLE_S, WARM_UP_S = 4, 4


class Used(typing.NamedTuple):
    """Since whenever: only differences mean something."""
    time_s: float
    servers_s: float
    postgres_s: float
    statements: int
    busy_s: float
    all_s: float

    def since(self, before):
        return Used(*(now - then for now, then in zip(self, before)))


class Measured(typing.NamedTuple):
    servers: int
    robots: int
    frames_hz: float       # reached
    cpu_ms: float          # a frame: servers and PostgreSQL, without what they take when idle
    statements: float      # a frame, likewise
    idle_cpu_percent: float  # of a core
    idle_statements_hz: float
    busy_percent: float    # of the machine
    is_stored: bool


def _use(database, servers):
    statements = database.sql("SELECT coalesce(sum(calls), 0) FROM pg_stat_statements s JOIN pg_database d ON "
                              "d.oid = s.dbid WHERE datname = 'paced'")
    return Used(time.monotonic(), sum(cpu_s(its.pid) for its in servers), cpu_with_children_s(database.pid),
                int(statements), *machine_cpu_s())


def _feed(context, database, servers, robots, window_s):
    """Between the lines "begin" and "end" of dhpmap-rig-paced: what was used, and frames; whether all is stored."""
    feed = subprocess.Popen(
        [context.bin / "dhpmap-rig-paced", "--servers", ",".join(its.grpc for its in servers), "--robots", str(robots),
         "--rate", str(RATE_HZ), "--warm-up", str(WARM_UP_S), "--window", str(window_s)],
        stdout=subprocess.PIPE, text=True)
    try:
        seen = {}
        for line in feed.stdout:
            found = re.match(r"(begin|end|stored) (-?\d+)$", line)
            if not found:
                print(line, end="")
                continue
            seen[found[1]] = (int(found[2]), _use(database, servers) if found[1] != "stored" else None)
        feed.wait(60)
    finally:
        feed.kill()
    frames = seen["end"][0] - seen["begin"][0]
    return seen["end"][1].since(seen["begin"][1]), frames, seen.get("stored", (-1,))[0] > 0


def _measure(context, database, num_servers, robots, window_s):
    url = database.create("paced")
    with contextlib.ExitStack() as stack:
        stack.callback(database.drop, "paced")
        servers = [stack.enter_context(Server(context.bin, url, context.folder)) for _ in range(num_servers)]
        time.sleep(1)
        before = _use(database, servers)
        time.sleep(IDLE_S)
        idle = _use(database, servers).since(before)
        used, frames, is_stored = _feed(context, database, servers, robots, window_s)
    share = used.time_s / idle.time_s
    cpu = used.servers_s + used.postgres_s - share * (idle.servers_s + idle.postgres_s)
    return Measured(num_servers, robots, frames / used.time_s, 1000 * cpu / max(frames, 1),
                    (used.statements - share * idle.statements) / max(frames, 1),
                    100 * (idle.servers_s + idle.postgres_s) / idle.time_s, idle.statements / idle.time_s,
                    100 * used.busy_s / used.all_s, is_stored)


def _spread(values):
    """The farthest from their mean, as a share of it."""
    mean = statistics.mean(values)
    return max(abs(its - mean) for its in values) / max(mean, 1e-9)


def paced(context):
    measured = []
    with Database(context.folder / "postgres") as database:
        for num_servers in (1, 2, 4):
            for robots in (8, 16, 32):
                its = _measure(context, database, num_servers, robots, context.scaled(12))
                measured.append(its)
                asked_hz = robots * RATE_HZ
                yield Row(f"{robots} paced robots on {num_servers} processes", f"{asked_hz:g} frames/s, all stored",
                          f"{its.frames_hz:.1f} frames/s; a frame {its.cpu_ms:.1f} ms CPU, {its.statements:.2f} "
                          f"statements; idle {its.idle_cpu_percent:.0f} % of a core, {its.idle_statements_hz:.0f} "
                          f"statements/s; machine {its.busy_percent:.0f} % busy",
                          its.is_stored and abs(its.frames_hz / asked_hz - 1) < 0.03)
    busy = max(its.busy_percent for its in measured)
    yield Row("the machine was busy, at most", "< 60 %", f"{busy:.0f} %", busy < 60)
    for what, values in (("CPU", [its.cpu_ms for its in measured]),
                         ("statements", [its.statements for its in measured])):
        yield Row(f"{what} a frame over all nine", "within 10 % of the mean",
                  f"{min(values):.2f} to {max(values):.2f}: {100 * _spread(values):.0f} %", _spread(values) <= 0.1)
