# SPDX-License-Identifier: BSD-3-Clause
"""Panoptic images: label images, and what says what their ids are."""
from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from dhpmap._errors import InvalidArgument
from dhpmap._frames import Segment
from dhpmap.mcap._messages import Detections

Labels = NDArray[np.generic]


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
    return np.where(np.isin(labels, list(segments)), labels, 0).astype(np.uint32), list(segments.values())


def segments_of_classes(labels: Labels, names: Mapping[int, str], divisor: int) -> tuple[Labels, list[Segment]]:
    """The labels, and a segment each of their ids, which are class ids, or class * divisor + number of the thing.

    Ids of classes without a name become 0, no label. If there is a class 0, all ids go up by one, for 0 is no label.
    """
    ids = np.unique(labels).astype(np.int64)
    classes = ids // divisor if divisor else ids
    shift = 1 if 0 in names else 0
    named = [(int(number), names[int(its)]) for number, its in zip(ids, classes) if int(its) in names]
    known = np.array([number for number, _ in named], np.int64)
    kept = np.where(np.isin(labels, known), labels.astype(np.int64) + shift, 0).astype(np.uint32)
    return kept, [Segment(number + shift, name) for number, name in named]
