#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs every command of docs/fleet.md (its ```sh blocks, in order, in one shell) against real programs.

    tests/e2e/fleet_page_test.py BIN_DIR

Installing and building are left out; folder and ports are this test's. Where Patroni, etcd, HAProxy or PostgreSQL are
not installed (deploy/setup.sh --fleet), only the shape of the commands is looked at.
"""
import os
import pathlib
import random
import re
import shutil
import socket
import subprocess
import sys
import tempfile

from operate_page_test import blocks, num_commands
from operate_stand_ins import ROOT

PAGE = ROOT / "docs/fleet.md"
FIRST_PORT, NUM_PORTS = 5700, 52
NOT_HERE = r"^(deploy/setup\.sh|cmake) .*\n"


def missing_programs():
    programs = ["patroni", "etcd", "/usr/sbin/haproxy", "psql"]
    missing = [its for its in programs if not shutil.which(its)]
    return missing + ([] if list(pathlib.Path("/usr/lib/postgresql").glob("*/bin/initdb")) else ["initdb"])


def is_free(port):
    with socket.socket() as its:
        its.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            its.bind(("127.0.0.1", port))
        except OSError:
            return False
        return True


def free_ports():
    """The first of as many in a row, below those that the system gives away."""
    while True:
        first = random.randrange(10000, 32000 - NUM_PORTS)
        if all(map(is_free, range(first, first + NUM_PORTS))):
            return first


def placed(script, work, first_port, bin_dir):
    script = re.sub(NOT_HERE, "", script, flags=re.M).replace('"$PWD/build/release/bin:', f'"{bin_dir}:')
    script = script.replace("up.sh", f"up.sh --port {first_port} --bin {bin_dir}")
    script = re.sub(r"deploy/fleet/(\w+\.sh)", rf"{ROOT}/deploy/fleet/\1 --dir {work}/fleet", script)
    return re.sub(r"\b57(\d\d)\b", lambda port: str(first_port + int(port[1])), script)


def main(bin_dir):
    text = PAGE.read_text()
    assert num_commands(blocks(text)[0]) == 10, "the page promises ten commands"
    script = "set -Eeuo pipefail\ntrap 'echo \"failed: $BASH_COMMAND\"' ERR\n" + "\n".join(blocks(text))
    subprocess.run(["bash", "-n", "-c", script], check=True)
    if missing := missing_programs():
        print(f"SKIPPED: docs/fleet.md was not tried: {', '.join(missing)} not installed (deploy/setup.sh --fleet)")
        return
    work = pathlib.Path(tempfile.mkdtemp(prefix="fleet.", dir="/var/tmp"))
    work.chmod(0o755)  # for the user that the fleet runs as
    try:
        environment = {name: value for name, value in os.environ.items() if not name.startswith("DHPMAP_")}
        done = subprocess.run(["bash", "-c", placed(script, work, free_ports(), bin_dir)], cwd=work, env=environment,
                              text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
        if done.returncode != 0:
            logs = "".join(f"\n{its.name}:\n" + "\n".join(its.read_text().splitlines()[-20:])
                           for its in (work / "fleet/log").glob("*.log"))
            sys.exit(f"{PAGE.name}:\n{done.stdout}{logs}")
        assert re.search(r"^ *1 .*renamed meanwhile", done.stdout, re.M), done.stdout
        print(f"{PAGE.name}: {sum(map(num_commands, blocks(text)))} commands")
    finally:
        subprocess.run([ROOT / "deploy/fleet/down.sh", "--dir", work / "fleet"], stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        shutil.rmtree(work)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]).resolve())
