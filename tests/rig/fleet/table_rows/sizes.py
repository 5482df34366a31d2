# SPDX-License-Identifier: BSD-3-Clause
"""A map of a million tiles, and ten thousand maps."""
import json
import re
import statistics
import time
import urllib.parse
import urllib.request

from .database import Database
from .processes import Server, cpu_s, numbers, run
from .row import Row, at_most


def tiles(context):
    num_tiles = context.scaled(1_000_000)
    with Database(context.folder / "postgres") as database:
        said = run(context.tests / "dhpmap_many_tiles_bench", database.url(), num_tiles)
    for what in ("made", "opened", "directory", "paged", "cloned", "exported", "deleted", "swept"):
        seconds, mib = numbers(what + r": ([\d.]+) s, ([\d.]+) MiB", said)
        more = {"paged": re.search(r"a tile of .*", said), "exported": re.search(r"map file: .*", said)}.get(what)
        yield Row(f"{num_tiles:,} tiles: {what}", "done",
                  f"{seconds:.1f} s, {mib:.0f} MiB" + (f"; {more[0]}" if more else ""), True)


def _page_ms(server, token=""):
    begin = time.monotonic()
    url = f"{server.http}/v1/maps?page_size=100&page_token={urllib.parse.quote(token)}"
    with urllib.request.urlopen(url, timeout=10) as answer:
        page = json.load(answer)
    return 1000 * (time.monotonic() - begin), page.get("next_page_token", "")


def _rest_pages(server):
    """Time of a page of 100, all over the catalog, and the server's CPU for one."""
    token, times_ms = "", []
    _page_ms(server)
    before_s = cpu_s(server.pid)
    while True:
        took_ms, token = _page_ms(server, token)
        times_ms.append(took_ms)
        if not token:
            return times_ms, 1000 * (cpu_s(server.pid) - before_s) / len(times_ms)


def _starts_s(context, url):
    times_s = []
    for _ in range(3):
        with Server(context.bin, url, context.folder) as server:
            times_s.append(server.started_s)
    return statistics.median(times_s)


def catalog(context):
    num_maps = context.scaled(10_000)
    with Database(context.folder / "postgres") as database:
        few, many = database.create("few"), database.create("many")
        run(context.tests / "dhpmap_catalog_bench", few, 10)
        said = run(context.tests / "dhpmap_catalog_bench", many, num_maps)
        database.sql("VACUUM ANALYZE")
        p50, p99 = numbers(r"a page of 100: p50 ([\d.]+) ms, p99 ([\d.]+) ms", said)
        places = ", ".join(re.findall(r"at \d+ %: p50 ([\d.]+) ms", said))
        yield Row(f"a page of 100 of {num_maps:,} maps, store, p50", "<= 5 ms",
                  f"{p50:.2f} ms (p99 {p99:.2f}; at five places {places})", p50 <= 5)
        p50, p99 = numbers(r"summary of a map: p50 ([\d.]+) ms, p99 ([\d.]+) ms", said)
        yield Row("summary of a map that is not open", "", f"p50 {p50:.3f} ms, p99 {p99:.3f} ms")
        start_s, few_s = _starts_s(context, many), _starts_s(context, few)
        yield Row(f"start with {num_maps:,} maps", "as with 10 (<= 1.25 x + 50 ms)",
                  f"{start_s:.2f} s, {few_s:.2f} s with 10", start_s <= 1.25 * few_s + 0.05)
        with Server(context.bin, many, context.folder) as owner, Server(context.bin, many, context.folder) as reader:
            times_ms, page_cpu_ms = _rest_pages(owner)
            yield Row("a page of 100 over REST", "",
                      f"p50 {statistics.median(times_ms):.1f} ms, {page_cpu_ms:.1f} ms CPU")
            yield from _watched(context, owner, reader)


def _watched(context, owner, reader):
    said = run(context.bin / "dhpmap-rig-watched", "--owner", owner.grpc, "--reader", reader.grpc, "--maps", 200,
               "--edits", context.scaled(600), timeout_s=180)
    p50, p99, most = numbers(r"its watch reports it after: p50 ([\d.]+) ms, p99 ([\d.]+) ms, most ([\d.]+)", said)
    yield at_most("200 maps watched on another process: woken, p50", 35, p50, " ms", digits=1)
    yield Row("the same, p99; an edit's answer", "",
              f"{p99:.1f} ms (most {most:.1f}); p50 {numbers(r'is answered after: p50 ([0-9.]+)', said)[0]:.1f} ms")


def sqlite_summaries(context):
    """Maps that are neither open nor among the summaries that a server keeps: straight from the file."""
    said = run(context.tests / "dhpmap_catalog_bench", context.folder / "catalog.db", context.scaled(3000))
    p50, p99 = numbers(r"summary of a map: p50 ([\d.]+) ms, p99 ([\d.]+) ms", said)
    yield Row("SQLite: summary of a map that is not open", "", f"p50 {p50:.3f} ms, p99 {p99:.3f} ms")
    p50, p99 = numbers(r"a page of 100: p50 ([\d.]+) ms, p99 ([\d.]+) ms", said)
    yield Row("SQLite: a page of 100 maps", "", f"p50 {p50:.2f} ms, p99 {p99:.2f} ms")
