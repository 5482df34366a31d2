# SPDX-License-Identifier: BSD-3-Clause
"""A row of the table, and the table as text."""
import os
import typing


class Row(typing.NamedTuple):
    name: str
    asked: str
    measured: str
    is_met: bool | None = None  # None: nothing is asked, or it could not be measured


def at_most(name, limit, value, unit="", digits=2):
    """A row that asks for no more than `limit`."""
    return Row(name, f"<= {limit:g}{unit}", f"{value:.{digits}f}{unit}", value <= limit)


def at_least(name, limit, value, unit="", digits=2):
    return Row(name, f">= {limit:g}{unit}", f"{value:.{digits}f}{unit}", value >= limit)


def load():
    return f"{os.getloadavg()[0]:.1f}"


def text(rows_and_loads):
    """Plain columns: row, asked, measured, met, load of the machine before and after."""
    verdict = {True: "met", False: "NOT MET", None: "-"}
    lines = [("row", "asked", "measured", "", "load")]
    lines += [(row.name, row.asked, row.measured, verdict[row.is_met], loads) for row, loads in rows_and_loads]
    widths = [max(len(line[i]) for line in lines) for i in range(5)]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in lines)
