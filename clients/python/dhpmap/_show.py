# SPDX-License-Identifier: BSD-3-Clause
"""How maps and objects show themselves in a notebook."""
from __future__ import annotations

from collections.abc import Iterable
from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from dhpmap._map import Map
    from dhpmap._objects import Object

MOST_ROWS = 50
_HEAD = ("id", "name", "class", "kind", "size / m", "at / m", "frames", "")


def _row(its: Object) -> tuple[str, ...]:
    box = its.box
    size = " x ".join(f"{side:.2f}" for side in box.size_m) if box else ""
    at = ", ".join(f"{axis:.2f}" for axis in (box.center_m if box else its.center_m))
    state = ", ".join(word for word, is_so in (("absent", not its.is_present), ("locked", its.is_locked)) if is_so)
    return str(its.id), its.name, its.class_name, its.kind, size, at, str(its.num_frames), state


def _table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    def line(cells: Iterable[str], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    return f"<table>{line(head, 'th')}{''.join(line(cells, 'td') for cells in rows)}</table>"


def objects_html(objects: Iterable[Object]) -> str:
    """A table of the first objects."""
    rows = [_row(its) for its in objects]
    left = f"<p>and {len(rows) - MOST_ROWS} more</p>" if len(rows) > MOST_ROWS else ""
    return _table(_HEAD, rows[:MOST_ROWS]) + left


def object_html(its: Object) -> str:
    return _table(_HEAD, [_row(its)])


def map_html(shown: Map) -> str:
    return f"<p><b>{escape(shown.name)}</b>: {escape(str(shown))}</p>" + objects_html(shown.objects)
