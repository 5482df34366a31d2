#!/usr/bin/python3 -B
# SPDX-License-Identifier: BSD-3-Clause
"""Kills PostgreSQL under Patroni, and whole hosts of it, while a robot feeds and somebody edits through the proxy of a
fleet (deploy/fleet): how long until something is stored again, and is all there that was acknowledged?

    tests/rig/fleet/patroni_faults.py [--dir DIR] [--port N] [--bin DIR] [--postgres N] [--hosts N] [--table FILE]

Makes the fleet in a new folder and deletes it; takes some 20 s a kill of PostgreSQL and 45 s a host. Exits with 1 if
anything is lost, twice, or later than asked. A table for docs/fleet.md goes to --table.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import time
import urllib.error
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "clients/python"), str(pathlib.Path(__file__).resolve().parent)]

import history  # noqa: E402
import verdict  # noqa: E402
from robot import Editor, Robot, create_map  # noqa: E402

LIMITS_S = {"postgres": 6, "host": 25}
FRAMES_PER_S, EDIT_PERIOD_S = 10, 0.1
MORE_HEARD = 3  # acknowledgements of each client between two faults, and after each


class Fleet:
    def __init__(self, options):
        self.folder, self.port, self.bin = options.dir, options.port, options.bin

    def run(self, script, *arguments):
        done = subprocess.run([ROOT / "deploy/fleet" / script, "--dir", self.folder, *arguments], text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        assert done.returncode == 0, f"{script}: {done.stdout}"
        return done.stdout

    def up(self):
        self.run("up.sh", "--port", str(self.port), *(["--bin", self.bin] if self.bin else []))

    def down(self, *how):
        self.run("down.sh", *how)

    def servers(self):
        return [line.split()[0] for line in self.run("part.sh", "list").splitlines() if line.startswith("server")]

    def ask_patroni(self, node, path):
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{self.port + 20 + node}/{path}", timeout=1) as answer:
                return json.load(answer)
        except (OSError, ValueError, urllib.error.URLError):
            return None

    def primary(self):
        return next((node for node in (1, 2, 3) if self.ask_patroni(node, "primary")), None)

    def is_whole(self):
        """A primary, and two standbys that stream, one of them synchronous."""
        cluster = next(filter(None, (self.ask_patroni(node, "cluster") for node in (1, 2, 3))), {"members": []})
        states = [its["state"] for its in cluster["members"]]
        roles = [its["role"] for its in cluster["members"]]
        return len(states) == 3 and set(states) <= {"running", "streaming"} and "leader" in roles \
            and "sync_standby" in roles and self.primary() is not None


def wait_for(is_so, seconds, what):
    end = time.monotonic() + seconds
    while not is_so():
        assert time.monotonic() < end, f"no {what} within {seconds} s"
        time.sleep(0.1)


def pause_s(heard_s, fault_s, until_s):
    """The longest time without an acknowledgement from a second before the fault on."""
    times = [fault_s - 1] + [its for its in heard_s if fault_s - 1 < its < until_s] + [until_s]
    return max(after - before for before, after in zip(times, times[1:]))


def hear_more(clients):
    """Waits for further acknowledgements of each client."""
    wanted = [len(its.heard_s) + MORE_HEARD for its in clients]
    for client, num in zip(clients, wanted):
        wait_for(lambda its=client, n=num: len(its.heard_s) >= n, 60, f"acknowledgements for {client}")


def kill(fleet, kind, clients):
    """One fault, until the fleet is whole again. The pauses of the clients, and the time until it was whole."""
    wait_for(fleet.is_whole, 120, "whole cluster")
    hear_more(clients)
    node, fault_s = fleet.primary(), time.monotonic()
    fleet.run("part.sh", "kill" if kind == "host" else "kill-postgres", f"pg{node}")
    wait_for(lambda: fleet.primary() not in (None, node), 60, "other primary")
    hear_more(clients)
    until_s = time.monotonic()
    if kind == "host":
        fleet.run("part.sh", "start", f"pg{node}")
    wait_for(fleet.is_whole, 120, "whole cluster")
    return [pause_s(its.heard_s, fault_s, until_s) for its in clients], time.monotonic() - fault_s


def table(results):
    lines = ["| killed | count | longest pause of edits: p50, max | of frames' acknowledgements: p50, max | "
             "whole again, max |", "|---|--:|--:|--:|--:|"]
    for kind, all_of_kind in results.items():
        if not all_of_kind:
            continue
        edits, frames, whole = zip(*all_of_kind)
        lines.append(f"| {kind} | {len(edits)} | {statistics.median(edits):.1f}, {max(edits):.1f} s | "
                     f"{statistics.median(frames):.1f}, {max(frames):.1f} s | {max(whole):.0f} s |")
    return "\n".join(lines) + "\n"


def run(fleet, options):
    address = f"127.0.0.1:{options.port + 50}"
    create_map(address)
    robot, editor = Robot(address, FRAMES_PER_S), Editor(address, EDIT_PERIOD_S)
    wait_for(lambda: robot.stored > 10 and editor.last_heard_s() > 0, 60, "first answers")
    kinds = ["postgres"] * options.postgres
    for i in range(options.hosts):  # spread among the others
        kinds.insert((i + 1) * len(kinds) // (options.hosts + 1), "host")
    results = {"postgres": [], "host": []}
    complaints = []
    for number, kind in enumerate(kinds, 1):
        (edits_s, frames_s), whole_s = kill(fleet, kind, [editor, robot])
        results[kind].append((edits_s, frames_s, whole_s))
        if max(edits_s, frames_s) > LIMITS_S[kind]:
            complaints.append(f"fault {number}, {kind}: back in {max(edits_s, frames_s):.1f} s")
        print(f"{number:3} {kind:8} edits {edits_s:5.1f} s  frames {frames_s:5.1f} s  whole after {whole_s:5.1f} s  "
              f"{robot.stored} frames, {len(editor.told)} edits acknowledged", flush=True)
    robot.end()
    editor.end()
    for what in ("kill", "start"):  # what follows is from the database
        for server in fleet.servers():
            fleet.run("part.sh", what, server)
    complaints += verdict.complaints(verdict.Told(robot.num_sent, robot.stored, editor.told), history.read(address))
    told = f"{robot.stored} frames and {len(editor.told)} edits were acknowledged as stored, in {robot.num_streams} " \
           f"streams; refused for the moment: {robot.refusals}"
    print(told)
    if options.table:
        pathlib.Path(options.table).write_text(table(results) + told + "\n")
    return complaints


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dir", default="/var/tmp/dhpmap-fleet-rig")
    parser.add_argument("--port", type=int, default=5800)
    parser.add_argument("--bin")
    parser.add_argument("--postgres", type=int, default=14, help="kills of PostgreSQL alone")
    parser.add_argument("--hosts", type=int, default=8, help="kills of Patroni with it")
    parser.add_argument("--table")
    options = parser.parse_args()
    fleet = Fleet(options)
    if pathlib.Path(options.dir).exists():
        sys.exit(f"{options.dir} is there already, and would be deleted")
    try:
        fleet.up()
        complaints = run(fleet, options)
    except BaseException:
        fleet.down()  # with the logs of what went wrong
        raise
    fleet.down("--delete")
    print("\n".join(complaints) or "nothing is lost, nothing is twice, nothing was late")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
