#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs every command of docs/operate.md (its ```sh blocks, in order, in one shell) against real programs.

    tests/e2e/operate_page_test.py BIN_DIR

Folders of the system become those of a temporary one, and ports free ones. What needs a system is stood in for: sudo
runs the command, systemctl does by hand what the unit says, its filter of system calls included, apt-get only knows the
packages' names (deploy/try_packages.sh installs them).
"""
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile

from operate_stand_ins import ROOT, STAND_INS

PAGE = ROOT / "docs/operate.md"
UNIT = ROOT / "deploy/debian/dhpmap-server.service"
FOLDERS = ("etc/dhpmap", "etc/cron.daily", "var/lib/dhpmap", "var/log/dhpmap", "var/backups", "home")

def blocks(text):
    return re.findall(r"^```sh\n(.*?)^```$", text, re.M | re.S)


def num_commands(block):
    """Lines, but for those of a here-document and those that go on."""
    without_documents = re.sub(r"(<<'END'\n).*?^END$\n", r"\1", block, flags=re.M | re.S)
    return len(without_documents.replace("\\\n", "").strip().splitlines())


def with_what_there_is(script, bin_dir):
    """Leaves out what these programs do not have yet, and says so; dhpmap doctor may warn, of a full disk here, say."""
    for program, word in (("dhpmap-server", "--check-config"), ("dhpmap", "doctor")):
        if not re.search(rf"^ +{word}\b", subprocess.check_output([bin_dir / program, "--help"], text=True), re.M):
            script, left_out = re.subn(rf"^.* {word}\n", "", script, flags=re.M)
            print(f"left out: {left_out} commands with {word}, which {program} does not have")
    return script.replace("maps doctor\n", "maps doctor || [ $? = 1 ]\n")


def has_seccomp():
    """Whether the server can run under the unit's filter: a system call that the unit forbids ends it then."""
    has = shutil.which("systemd-analyze") and \
        subprocess.run(["/usr/bin/python3", "-c", "import seccomp"], capture_output=True).returncode == 0
    if not has:
        print("without the unit's filter of system calls: install python3-seccomp and systemd")
    return has


def check_settings(bin_dir, work):
    """What the package puts into /etc/dhpmap, and what is commented out there, are settings that the server knows."""
    text = (ROOT / "deploy/debian/dhpmap.yaml").read_text()
    (work / "all.yaml").write_text(re.sub(r"^#(?! )", "", text, flags=re.M).replace("#  ", "  "))
    command = [bin_dir / "dhpmap-server", "--config", work / "all.yaml", "--insecure-no-auth", "--print-config"]
    shown = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout
    assert "0.0.0.0:50051" in shown and "audit.jsonl" in shown, shown


def free_ports(count):
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [its.getsockname()[1] for its in sockets]
    for its in sockets:
        its.close()
    return ports


def placed(text, work):
    """The same with this test's folders, ports and name of the machine."""
    for folder in ("/etc/", "/var/lib/", "/var/log/", "/var/backups"):
        text = text.replace(f" {folder}", f" {work}{folder}").replace(f">{folder}", f">{work}{folder}")
    for port, ours in zip(("50051", "8080", "50061", "50062"), free_ports(4)):
        text = re.sub(rf"\b{port}\b", str(ours), text)
    # curl alone knows this name, and the REST door accepts it only if the settings say so.
    text = re.sub(r"(https://|DNS:|allowed_hosts: )maps\.example", r"\1maps.localhost", text)
    return text.replace("maps.example", "127.0.0.1").replace("0.0.0.0", "127.0.0.1")


def main(bin_dir):
    text = PAGE.read_text()
    assert num_commands(blocks(text)[0]) == 10, "the page promises ten commands"
    work = pathlib.Path(tempfile.mkdtemp(prefix="operate."))
    try:
        for folder in FOLDERS:
            (work / folder).mkdir(parents=True)
        check_settings(bin_dir, work)
        for name, body in STAND_INS.items():
            (work / "bin").mkdir(exist_ok=True)
            (work / "bin" / name).write_text("#!/bin/sh\n" + body)
            (work / "bin" / name).chmod(0o755)
        exec_start = re.search(r"^ExecStart=/usr/bin/(.*)$", UNIT.read_text(), re.M).group(1)
        if has_seccomp():
            exec_start = f"{ROOT}/deploy/packaging/as_the_unit_allows.py {UNIT} --kill {exec_start}"
        environment = {name: value for name, value in os.environ.items() if not name.startswith("DHPMAP_")}
        environment |= {"PATH": f"{work}/bin:{bin_dir}:{os.environ['PATH']}", "JOURNAL": str(work / "journal"),
                        "EXEC_START": placed(exec_start, work), "HOME": str(work / "home")}
        subprocess.run([bin_dir / "dhpmap-simulate", "recording", "--frames", "6", "--width", "80", "--height", "60",
                        "--quiet"], cwd=work / "home", check=True, stdout=subprocess.DEVNULL)
        script = placed(with_what_there_is("\n".join(blocks(text)), bin_dir), work)
        guard = "set -Eeuo pipefail\ntrap 'echo \"failed: $BASH_COMMAND\"' ERR\n"
        done = subprocess.run(["bash", "-c", guard + script], cwd=work / "home", env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
        if done.returncode != 0:
            sys.exit(f"{PAGE.name}:\n{done.stdout}\nThe server's log:\n{(work / 'journal').read_text()}")
        assert "dhpmap_map_submaps" in (work / "home/metrics.txt").read_text()
        assert sorted(path.suffix for path in (work / "var/backups/dhpmap").iterdir()) == [".db"]
        assert "END" not in (work / "etc/dhpmap/dhpmap.yaml").read_text()
        print(f"{PAGE.name}: {sum(map(num_commands, blocks(text)))} commands")
    finally:
        stop(work / "journal.pid")
        shutil.rmtree(work)


def stop(pid_file):
    if pid_file.exists():
        try:
            os.kill(int(pid_file.read_text()), signal.SIGKILL)
        except ProcessLookupError:
            pass


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]).resolve())
