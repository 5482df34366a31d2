# SPDX-License-Identifier: BSD-3-Clause
"""Several servers on one database: takeovers, and how far another process is behind."""
from .processes import numbers, run
from .row import Row, at_most

LEASE_S, TIMEOUT_S, POLL_MS = 2, 1, 50


def takeovers(context):
    """dhpmap-rig-takeovers exits with 1 if there are complaints, so its text is taken in any case."""
    faults = context.scaled(50)
    try:
        said = run(context.bin / "dhpmap-rig-takeovers", "--faults", faults, "--kinds", "kill,stop", "--servers", 4,
                   "--robots", 32, "--timeout", TIMEOUT_S, timeout_s=900)
    except RuntimeError as failed:
        said = str(failed)
    frames, edits = numbers(r"(\d+) frames and (\d+) edits acknowledged", said)
    complaints = int(numbers(r"\n(\d+) complaints", said)[0])
    yield Row(f"{faults} faults of 4 processes, 32 robots: lost or doubled", "0",
              f"{complaints} complaints; {frames:.0f} frames, {edits:.0f} edits acknowledged", complaints == 0)
    if complaints:
        print(said[said.index("complaints"):])
    for kind, limit_s in (("killed", LEASE_S + 0.5), ("stopped", LEASE_S + 0.5 + TIMEOUT_S)):
        count, p50, p99, most = numbers(kind + r": (\d+) waits, p50 ([\d.]+) s, p99 ([\d.]+) s, longest ([\d.]+)", said)
        yield Row(f"takeover, server {kind}, p99", f"<= {limit_s:g} s",
                  f"{p99:.2f} s (p50 {p50:.2f}, longest {most:.2f}, of {count:.0f})", p99 <= limit_s)


def watchers(context):
    said = run(context.tests / "dhpmap_follow_bench", context.scaled(100))
    p50, p99 = numbers(r"watchers are woken after +p50 +([\d.]+) +p99 +([\d.]+)", said)
    yield Row("watcher on another process, behind, p50", f"<= {POLL_MS / 2 + 10:g} ms", f"{p50:.1f} ms (p99 {p99:.1f})",
              p50 <= POLL_MS / 2 + 10)
    p50, p99 = numbers(r"the copy is there after +p50 +([\d.]+) +p99 +([\d.]+)", said)
    yield Row("copy on another process, behind, p50", "", f"{p50:.1f} ms (p99 {p99:.1f})")
