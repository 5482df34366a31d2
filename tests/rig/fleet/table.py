#!/usr/bin/python3 -B
# SPDX-License-Identifier: BSD-3-Clause
"""Measures what several servers on PostgreSQL must show, and prints one table.

    tests/rig/fleet/table.py [ROW ...] [--build DIR] [--before BIN] [--folder DIR] [--quick] [--out FILE]

Columns: row, asked, measured, met or not, load of the machine before and after. Rows: commits reads takeovers paced
watchers tiles catalog sqlite_summaries sqlite_pairs. All take some 15 minutes on two quiet cores; nothing else should
run. Each makes a PostgreSQL of its own in a new folder and deletes it. Exits with 1 if a row is not met or could not be
measured. Kills of PostgreSQL under Patroni: patroni_faults.py.
"""
import argparse
import pathlib
import shutil
import signal
import sys
import tempfile
import time
import traceback

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from table_rows import fleet, paced, row, sizes, store  # noqa: E402

ROWS = {"commits": store.commits, "reads": store.reads, "takeovers": fleet.takeovers, "paced": paced.paced,
        "watchers": fleet.watchers, "tiles": sizes.tiles, "catalog": sizes.catalog,
        "sqlite_summaries": sizes.sqlite_summaries, "sqlite_pairs": store.sqlite_pairs}
TARGETS = "dhpmap-server dhpmap-bench dhpmap-simulate dhpmap-rig-takeovers dhpmap-rig-paced dhpmap-rig-watched " \
    "dhpmap_postgres_bench dhpmap_follow_bench dhpmap_catalog_bench dhpmap_many_tiles_bench"
QUICK_SHARE = 0.1


class Context:
    """Where programs are, and where a row may write."""

    def __init__(self, options):
        self.bin, self.tests = options.build / "bin", options.build / "tests"
        self.before, self._share = options.before, QUICK_SHARE if options.quick else 1
        self.folder = None

    def scaled(self, number):
        return max(2, int(number * self._share))

    def missing(self):
        found = [path.name for path in (*self.bin.glob("*"), *self.tests.glob("*"))]
        return [its for its in TARGETS.split() if its not in found]


def measure(name, context, options):
    """The rows, each with the load before and after it. One that fails is a row, too."""
    load, begin = row.load(), time.monotonic()
    context.folder = pathlib.Path(tempfile.mkdtemp(prefix=f"{name}-", dir=options.folder))
    context.folder.chmod(0o755)  # PostgreSQL's user goes through it
    try:
        for its in ROWS[name](context):
            print(f"  {its.name}: {its.measured}", flush=True)
            yield its, f"{load} - {row.load()}"
    except Exception:  # the others are measured nevertheless
        traceback.print_exc()
        yield row.Row(f"{name}: failed, see above", "", "", False), f"{load} - {row.load()}"
    finally:
        shutil.rmtree(context.folder, ignore_errors=True)
        print(f"{name}: {time.monotonic() - begin:.0f} s", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("rows", nargs="*", metavar="ROW", help=" ".join(ROWS))
    parser.add_argument("--build", type=lambda its: pathlib.Path(its).resolve(), default=ROOT / "build/release")
    parser.add_argument("--before", type=pathlib.Path, help="folder of an older build's programs, for sqlite_pairs")
    parser.add_argument("--folder", default="/var/tmp", help="where the databases lie for the moment")
    parser.add_argument("--quick", action="store_true", help="a tenth of each: whether it runs, not for figures")
    parser.add_argument("--out", type=pathlib.Path, help="file for the table, too")
    options = parser.parse_args()
    if unknown := set(options.rows) - set(ROWS):
        parser.error(f"no such row: {', '.join(sorted(unknown))}")
    context = Context(options)
    if missing := context.missing():
        sys.exit(f"build these targets first: {' '.join(missing)}")
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    done = [its for name in options.rows or ROWS for its in measure(name, context, options)]
    print("\n" + row.text(done))
    if options.out:
        options.out.write_text(row.text(done) + "\n")
    return 1 if any(its.is_met is False for its, _ in done) else 0


if __name__ == "__main__":
    sys.exit(main())
