# SPDX-License-Identifier: BSD-3-Clause
"""Label sets of data sets on which networks are trained, as ready files."""
from __future__ import annotations

import csv
import pathlib
from typing import Literal

from dhpmap._errors import bad_argument
from dhpmap._map_info import Label

_FOLDER = pathlib.Path(__file__).parent / "label_sets"
_SIZES: dict[str, Literal["small", "medium", "large"]] = {"S": "small", "M": "medium", "L": "large"}


def label_sets() -> list[str]:
    """The names that `label_set` takes. Their files, in label_sets/, are label tables of the flat layout too."""
    return sorted(path.stem for path in _FOLDER.glob("*.csv"))


def label_set(name: str, *, ids: Literal["data_set", "network"] = "data_set") -> list[Label]:
    """The classes of a data set, for Server.create: coco_panoptic, ade20k_150, cityscapes or semantic_kitti.

    ids: as the data set's files have them, or as networks that are trained on it number them, from 0 (of semantic_kitti
    from 1); classes that these leave out are then not in it. Sizes are ours. Raises InvalidArgument for another name.
    """
    if name not in label_sets():
        raise bad_argument("name", f"there is no label set {name!r}; there are {', '.join(label_sets())}")
    if ids not in ("data_set", "network"):
        raise bad_argument("ids", f"wanted 'data_set' or 'network', got {ids!r}")
    column = "ClassID" if ids == "data_set" else "NetworkID"
    with open(_FOLDER / f"{name}.csv", newline="", encoding="utf-8") as file:
        return [Label(int(row[column]), row["Name"], "thing" if row["PanopticID"] == "1" else "stuff",
                      _SIZES[row["Size"]]) for row in csv.DictReader(file) if row[column]]
