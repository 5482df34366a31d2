# SPDX-License-Identifier: BSD-3-Clause
"""The store alone: commits, reads, owners at once; a file before and after."""
import pathlib
import statistics

from .database import Database
from .processes import numbers, run
from .row import Row, at_least, at_most


def _bench(context, standbys):
    files = context.folder / "files"
    files.mkdir(exist_ok=True)
    with Database(context.folder / "postgres", standbys) as database:
        return run(context.tests / "dhpmap_postgres_bench", database.url(), files, context.scaled(60))


def commits(context):
    """Quorum of one of two standbys, beside SQLite with a full sync."""
    said = _bench(context, standbys=2)
    sqlite_ms, postgres_ms, ratio = numbers(
        r"commit of 50 tiles.*FULL ([\d.]+) /.*PostgreSQL ([\d.]+) /.*: ([\d.]+) x", said)
    wal, hot = numbers(r"WAL / blobs written: ([\d.]+); HOT updates of maps: ([\d.]+) %", said)
    yield Row("commit of 50 tiles, quorum 1 of 2, p50", "<= 4.5 x SQLite FULL",
              f"{ratio:.2f} x ({postgres_ms:.1f} / {sqlite_ms:.1f} ms)", ratio <= 4.5)
    yield at_most("round trips a commit", 3, numbers(r"round trips a commit: (\d+)", said)[0], digits=0)
    yield at_most("WAL / blobs", 1.25, wal)
    yield at_least("HOT updates of maps", 95, hot, " %", digits=1)


def reads(context):
    """One PostgreSQL without standbys: reads, and eight maps at once."""
    said = _bench(context, standbys=0)
    yield at_most("whole map by one SELECT, decoded", 2, numbers(r"whole map of.*: ([\d.]+) x", said)[0], " x")
    by_map, by_64, by_key = numbers(
        r"a blob, us:.*by map [\d.]+: ([\d.]+) x, by 64 keys [\d.]+: ([\d.]+) x, by key [\d.]+: ([\d.]+) x", said)
    yield at_most("blobs of a map by 64 keys, beside SQLite by key", 5, by_64, " x")
    yield Row("blobs of a map by one SELECT; by key", "", f"{by_map:.2f} x; {by_key:.2f} x")
    yield at_most("point read: a tile read and decoded, p50", 6,
                  numbers(r"a tile read and decoded.*?: ([\d.]+) x; GetMap", said)[0], " x")
    yield Row("GetMap, p50", "", f"{numbers(r'GetMap .*: ([0-9.]+) x', said)[0]:.2f} x")
    one, eight, ratio = numbers(r"PostgreSQL ([\d.]+), ([\d.]+): ([\d.]+) x", said.split("commits/s of 1 map", 1)[1])
    yield Row("8 owners against 1, no standbys, commits/s", ">= 1.5 x", f"{ratio:.2f} x ({eight:.0f} / {one:.0f})",
              ratio >= 1.5)


def sqlite_pairs(context):
    """dhpmap-bench of two builds in turns, on the same recording: CPU of commits and of loads."""
    if context.before is None:
        yield Row("SQLite path, paired", "no slower", "not measured: --before BIN")
        return
    recording = context.folder / "recording"
    run(context.bin / "dhpmap-simulate", recording, "--frames", 20, "--width", 160, "--height", 120, "--quiet")
    ratios = {"commit, all of them": [], "load": []}
    for pair in range(context.scaled(5)):
        builds = [context.bin, pathlib.Path(context.before)]
        said = {its: run(its / "dhpmap-bench", "store", recording, "--mib", 12, "--repetitions", 0, "--scratch",
                         context.folder) for its in (builds if pair % 2 == 0 else builds[::-1])}
        for what, of_pairs in ratios.items():
            now_s, before_s = (numbers(what + r" +[\d.]+ +[\d.]+ +([\d.]+)", said[its])[0] for its in builds)
            of_pairs.append(now_s / max(before_s, 1e-3))
    for what, of_pairs in ratios.items():
        ratio = statistics.median(of_pairs)
        yield Row(f"SQLite path, paired: {what.split(',')[0]}, CPU", "no slower (<= 1.05 x)",
                  f"{ratio:.3f} x, {min(of_pairs):.2f} to {max(of_pairs):.2f} of {len(of_pairs)}", ratio <= 1.05)
