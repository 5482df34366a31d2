# SPDX-License-Identifier: BSD-3-Clause
"""Which rooms sanitizers take first: those that the commits of the last day touched, newest first, then the others by turn."""
import datetime
import os
import subprocess


def git(*arguments):
    return subprocess.run(["git", *arguments], check=True, capture_output=True, text=True).stdout


def touched_files():
    """Files that commits of the 24 hours up to the newest one touched, and what is not committed: newest first."""
    newest = datetime.datetime.fromisoformat(git("log", "-1", "--format=%cI").strip())
    since = (newest - datetime.timedelta(hours=24)).isoformat()
    return git("diff", "--name-only", "HEAD").splitlines() + git(
        "log", f"--since={since}", "--format=", "--name-only").splitlines()


def rooms_of(file, rooms):
    """The rooms of `rooms` whose tests concern a file: its own, and `integration` for all that is served."""
    folder = os.path.dirname(file)
    place = folder[len("tests/"):] if folder.startswith("tests/") else "unit/" + folder
    found = []
    while place and not found:
        found = [room for room in rooms if room == place]
        place = os.path.dirname(place)
    if folder.startswith(("server", "tests/support")) and "integration" in rooms:
        found.append("integration")
    return found


def in_order(rooms, files, turn):
    """All of `rooms`: those that `files` touch in their order, then the others, beginning with another one each turn."""
    first = list(dict.fromkeys(room for file in files for room in rooms_of(file, rooms)))
    others = [room for room in rooms if room not in first]
    start = turn % len(others) if others else 0
    return first + others[start:] + others[:start]


def number_of_commits():
    return int(git("rev-list", "--count", "HEAD"))
