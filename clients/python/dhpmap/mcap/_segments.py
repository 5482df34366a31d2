# SPDX-License-Identifier: BSD-3-Clause
"""Panoptic images: label images, and what says what their ids are."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dhpmap._errors import InvalidArgument
from dhpmap._frames import Segment
from dhpmap.mcap._messages import Detections

Labels = NDArray[Any]

MOST_COUNTED = 1 << 20  # ids up to it are looked up in a table


def segments_of_detections(labels: Labels, table: Detections, names: Mapping[int, str], topic: str
                           ) -> tuple[Labels, list[Segment]]:
    """The labels, and a segment a detection, whose `id` is the pixels' value. A class is named, or numbered."""
    segments = {}
    for its in table.detections:
        if not its.id.isdecimal() or not 0 < int(its.id) < 1 << 32:
            raise InvalidArgument(f"{topic}: a detection has the id {its.id!r}; in a label image's table it is the "
                                  "value of its pixels, above 0")
        class_id: str | int | None = its.class_id or None
        if its.class_id.isdecimal():
            class_id = names.get(int(its.class_id), int(its.class_id))
        segments[int(its.id)] = Segment(int(its.id), class_id, score=min(max(its.score, 0.0), 1.0))
    return _renumbered(labels, {number: number for number in segments}), list(segments.values())


def segments_of_classes(labels: Labels, names: Mapping[int, str], divisor: int) -> tuple[Labels, list[Segment]]:
    """The labels, and a segment each of their ids, which are class ids, or class * divisor + number of the thing.

    Ids of classes without a name become 0, no label. If there is a class 0, all ids go up by one, for 0 is no label.
    """
    shift = 1 if 0 in names else 0
    named = {number: names[its] for number in _distinct(labels)
             if (its := number // divisor if divisor else number) in names}
    kept = _renumbered(labels, {number: number + shift for number in named})
    return kept, [Segment(number + shift, name) for number, name in named.items()]


def _distinct(labels: Labels) -> list[int]:
    """The ids in an image, ascending. Counting is several times as fast as sorting, where ids are small."""
    if labels.size == 0 or labels.min() < 0 or labels.max() > MOST_COUNTED:
        ids: list[int] = np.unique(labels).tolist()
    else:
        ids = np.flatnonzero(np.bincount(labels.ravel())).tolist()
    return ids


def _renumbered(labels: Labels, numbers: Mapping[int, int]) -> Labels:
    """The image with other numbers for its ids; those that have none become 0."""
    if labels.size == 0 or labels.min() < 0 or labels.max() > MOST_COUNTED:
        keys = np.array(sorted(numbers), np.int64)
        values = np.array([numbers[its] for its in sorted(numbers)] + [0], np.uint32)
        places = np.searchsorted(keys, labels)
        return np.where(np.isin(labels, keys), values[places], 0).astype(np.uint32)
    table = np.zeros(int(labels.max()) + 1, np.uint32)
    for number, its in numbers.items():
        if number < len(table):
            table[number] = its
    return table[labels]
