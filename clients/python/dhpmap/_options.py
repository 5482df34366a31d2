# SPDX-License-Identifier: BSD-3-Clause
"""Options that queries share, as keywords."""
from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from typing import Literal, TypedDict, TypeVar

from numpy.typing import ArrayLike

from dhpmap._arrays import numbers
from dhpmap._errors import bad_argument
from dhpmap._objects import Object, ObjectLike, Ref, submap_name
from dhpmap._pose import pose_message
from dhpmap.v1 import query_options_pb2 as pb2

Item = TypeVar("Item")
Touched = ObjectLike | str  # an object, or by its name a class


class QueryOptions(TypedDict, total=False):
    """Keywords of queries. One that a query has no use for is refused with InvalidArgument.

    Keys:
        ignore: objects, and classes by name, that are taken as not there.
        classes: names; only objects of these classes count.
        max_distance_m: up to 1,000; default 3.
        unknown: "report", "free" or "occupied": what unseen space is. Default: it is told, and in the way of robots.
        vacated: "unknown" or "free": where an edited object was and nobody has looked since. Default "unknown".
        max_free_age_s: free space that was seen longer ago than this counts as unknown.
        include_absent: also objects that are gone.
        padding_m: surfaces are grown by so much, 0 to 10.
        padding_of: the same for some objects, and classes by name: {"chair": 0.1}.
        attached: what the robot carries; it leaves its place. With T_robot_object, (4, 4), of paths: {cup: T}.
        may_touch: objects, and classes by name, that the robot may touch. By part of it: {"wheel": ["floor"],
            cup: [table]}, with links by name, what it carries, or None for all of it.
        T_map_query: (4, 4) the frame in which it is asked and answered; default: the map's.
        tolerance_vox: of distances: how much too long one may be, in voxels; 0.4 and more is faster. Default 0: exact.
        min_revision: wait until the map is so far.
    """

    ignore: Iterable[Touched]
    classes: Iterable[str]
    max_distance_m: float
    unknown: Literal["report", "free", "occupied"]
    vacated: Literal["unknown", "free"]
    max_free_age_s: float
    include_absent: bool
    padding_m: float
    padding_of: Mapping[Touched, float]
    attached: Iterable[ObjectLike] | Mapping[ObjectLike, ArrayLike]
    may_touch: Iterable[Touched] | Mapping[str | Object | Ref | None, Iterable[Touched]]
    T_map_query: ArrayLike
    tolerance_vox: float
    min_revision: int


_UNKNOWN = {"report": pb2.QueryOptions.REPORT, "free": pb2.QueryOptions.FREE, "occupied": pb2.QueryOptions.OCCUPIED}
_VACATED = {"unknown": pb2.Vacated.UNKNOWN, "free": pb2.Vacated.FREE}


def options_message(map_name: str, options: QueryOptions) -> pb2.QueryOptions:
    """Raises InvalidArgument for bad values, TypeError for a keyword that there is not."""
    refuse_unknown_keywords(options)
    out = pb2.QueryOptions()
    if "unknown" in options:
        out.unknown_policy = choice("unknown", options["unknown"], _UNKNOWN)
    if "vacated" in options:
        out.vacated_policy = choice("vacated", options["vacated"], _VACATED)
    if "max_distance_m" in options:
        out.max_distance_m = scalar("max_distance_m", options["max_distance_m"])
    if "max_free_age_s" in options:
        out.max_free_age_s = scalar("max_free_age_s", options["max_free_age_s"])
    if "tolerance_vox" in options:
        out.tolerance_vox = scalar("tolerance_vox", options["tolerance_vox"])
    if "T_map_query" in options:
        out.map_from_query.CopyFrom(pose_message("T_map_query", options["T_map_query"]))
    out.include_absent = options.get("include_absent", False)
    out.min_revision = options.get("min_revision", 0)
    out.class_names.extend(strings("classes", options.get("classes", ())))
    for ignored in listed("ignore", options.get("ignore", ())):
        if isinstance(ignored, str):
            out.excluded_class_names.append(ignored)
        else:
            out.excluded_submaps.append(submap_name(map_name, ignored))
    _fill_padding(out, map_name, options)
    _fill_robot(out, map_name, options)
    return out


def _fill_padding(out: pb2.QueryOptions, map_name: str, options: QueryOptions) -> None:
    if "padding_m" in options:
        out.padding.default_padding_m = scalar("padding_m", options["padding_m"])
    for grown, by_m in options.get("padding_of", {}).items():
        if isinstance(grown, str):
            out.padding.classes.add(class_name=grown, padding_m=scalar("padding_of", by_m))
        else:
            out.padding.submaps.add(submap=submap_name(map_name, grown), padding_m=scalar("padding_of", by_m))


def _fill_robot(out: pb2.QueryOptions, map_name: str, options: QueryOptions) -> None:
    attached = options.get("attached", ())
    if isinstance(attached, Mapping):
        for carried, T_robot_object in attached.items():
            out.attached.add(submap=submap_name(map_name, carried),
                             robot_from_submap=pose_message("attached", T_robot_object))
    else:
        for carried in listed("attached", attached):
            out.attached.add(submap=submap_name(map_name, carried))
    may_touch = options.get("may_touch", ())
    by_part = may_touch if isinstance(may_touch, Mapping) else {None: may_touch}
    for part, touched in by_part.items():
        for thing in listed("may_touch", touched):
            allowed = out.allowed_collisions.add()
            if isinstance(part, str):
                allowed.link = part
            elif part is not None:
                allowed.attached = submap_name(map_name, part)
            if isinstance(thing, str):
                allowed.class_name = thing
            else:
                allowed.submap = submap_name(map_name, thing)


def refuse_unknown_keywords(options: QueryOptions) -> None:
    for name in options:
        if name not in QueryOptions.__annotations__:
            near = difflib.get_close_matches(name, QueryOptions.__annotations__, 1)
            raise TypeError(f"there is no option {name!r}" + (f"; did you mean {near[0]!r}?" if near else ""))


def choice(name: str, value: str, values: Mapping[str, Item]) -> Item:
    if value not in values:
        raise bad_argument(name, f"{value!r} is none of {', '.join(map(repr, values))}")
    return values[value]


def scalar(name: str, value: float) -> float:
    array = numbers(name, value)
    if array.ndim != 0:
        raise bad_argument(name, f"wanted one number, got shape {array.shape}")
    return float(array)


def strings(name: str, values: Iterable[str]) -> list[str]:
    out = list(listed(name, values))
    for value in out:
        if not isinstance(value, str):
            raise bad_argument(name, f"wanted names of classes, got a {type(value).__name__}: {value!r}")
    return out


def listed(name: str, values: Iterable[Item]) -> Iterable[Item]:
    """What is to be a list; a lone string or object is a slip that would be taken apart."""
    if isinstance(values, (str, Object, Ref)) or not isinstance(values, Iterable):
        raise bad_argument(name, f"wanted a list, got {values!r}; write [{values!r}]")
    return values
