#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs a command with what the unit's SystemCallFilter and MemoryDenyWriteExecute leave, where systemd does not run.

    deploy/packaging/as_the_unit_allows.py UNIT [--kill] COMMAND...

Other system calls fail with EPERM, as in the unit; with --kill they end the process, which shows what would be missing.
"""
import errno
import os
import re
import subprocess
import sys

import seccomp


def calls_of(group):
    """Names of a group such as @system-service, groups in it included."""
    lines = subprocess.check_output(["systemd-analyze", "syscall-filter", group], text=True).splitlines()
    for name in (line.strip() for line in lines[1:]):
        if name.startswith("@"):
            yield from calls_of(name)
        elif name and not name.startswith("#"):
            yield name


def allowed(unit):
    names = set(calls_of("@default"))
    for line in re.findall(r"^SystemCallFilter=(.+)$", unit, re.M):
        listed = {call for word in line.lstrip("~").split() for call in (calls_of(word) if word[0] == "@" else [word])}
        names = names - listed if line[0] == "~" else names | listed
    return names


def install(unit, otherwise):
    if "MemoryDenyWriteExecute=yes" in unit:  # before the other filter, which leaves no system call to add one
        executable = 0x4
        both = executable | 0x2  # and writable
        rules = seccomp.SyscallFilter(defaction=seccomp.ALLOW)
        rules.add_rule(otherwise, "mmap", seccomp.Arg(2, seccomp.MASKED_EQ, both, both))
        for call in ("mprotect", "pkey_mprotect"):
            rules.add_rule(otherwise, call, seccomp.Arg(2, seccomp.MASKED_EQ, executable, executable))
        rules.load()
    rules = seccomp.SyscallFilter(defaction=otherwise)
    # As root, SQLite gives its files to the owner of the database.
    as_root = set(calls_of("@chown")) if os.geteuid() == 0 else set()
    for name in sorted(allowed(unit) | as_root):
        try:
            rules.add_rule(seccomp.ALLOW, name)
        except (RuntimeError, ValueError, OSError):
            pass  # of another architecture
    rules.load()


def main(arguments):
    with open(arguments[0], encoding="utf-8") as file:
        unit = file.read()
    command = arguments[1:]
    otherwise = seccomp.ERRNO(errno.EPERM)
    if command[0] == "--kill":
        command, otherwise = command[1:], seccomp.KILL_PROCESS
    install(unit, otherwise)
    os.execvp(command[0], command)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1:])
