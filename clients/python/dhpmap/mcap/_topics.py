# SPDX-License-Identifier: BSD-3-Clause
"""Which topic of a recording is what."""
from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from dhpmap._errors import InvalidArgument
from dhpmap.mcap._messages import (CAMERA_INFO, COMPRESSED_IMAGE, DETECTIONS, IMAGE, LABEL_INFO, POINT_CLOUD, TF)
from dhpmap.mcap._options import FrameOptions
from dhpmap.mcap._recording import Topic

IMAGES = (IMAGE, COMPRESSED_IMAGE)
TABLES = (LABEL_INFO, DETECTIONS)
_TYPES = {"depth": IMAGES, "color": IMAGES, "labels": IMAGES, "cloud": (POINT_CLOUD,), "camera_info": (CAMERA_INFO,),
          "label_table": TABLES, "tf": (TF,)}
_WORDS = {"labels": ("label", "segm", "panoptic", "semantic"), "depth": ("depth",),
          "color": ("color", "colour", "rgb", "image_rect")}  # the first that fits


@dataclass(frozen=True, slots=True)
class Chosen:
    """Names of topics; "": there is none."""

    lead: str  # of depth images, or of clouds
    is_cloud: bool
    color: str
    camera_info: str
    labels: str
    label_table: str
    transforms: tuple[str, ...]


def type_of(topic: Topic) -> str:
    """With "/msg/", which some writers leave out."""
    package, _, name = topic.type.partition("/")
    return topic.type if "/" in name or not name else f"{package}/msg/{name}"


def role_of(topic: Topic) -> str:
    """What it is taken for if nobody says otherwise; "": nothing."""
    if topic.encoding != "cdr":
        return ""
    kind = type_of(topic)
    if kind not in IMAGES:
        return next((role for role, types in _TYPES.items() if kind in types), "")
    return next((role for role, words in _WORDS.items() if any(word in topic.name.lower() for word in words)), "")


def choose(topics: Sequence[Topic], options: FrameOptions) -> Chosen:
    """Raises InvalidArgument, which names the topics that there are, if it is not clear which one is meant."""
    if options.get("depth") and options.get("cloud"):
        raise InvalidArgument("depth and cloud are both given; feed one, then the other, in sessions of their own")
    depth = _one("depth", topics, options.get("depth", "" if options.get("cloud") else None))
    cloud = "" if depth else _one("cloud", topics, options.get("cloud"))
    if not (depth or cloud):
        raise InvalidArgument(f"no topic holds depth images or clouds: say depth= or cloud=; there are {_told(topics)}")
    beside = None if depth else ""  # a cloud has no images, unless they are asked for
    labels = _one("labels", topics, options.get("labels", beside))
    if labels and options.get("label_field"):
        raise InvalidArgument("labels and label_field are both given: take an image's labels, or those of the cloud")
    color = _one("color", topics, options.get("color", beside))
    image = depth or color or labels
    has_labels = bool(labels or options.get("label_field"))
    table = _one("label_table", topics, options.get("label_table", None if has_labels else ""))
    if has_labels and not (table or options.get("classes")):
        raise InvalidArgument(f"nothing says what the ids of {labels or 'the labels'} are: say label_table= or "
                              "classes=, or labels='' to feed without")
    return Chosen(depth or cloud, not depth, color,
                  _camera_info(topics, image, options.get("camera_info")) if image else "", labels, table,
                  tuple(its.name for its in topics if role_of(its) == "tf"))


def _one(role: str, topics: Sequence[Topic], named: str | None) -> str:
    """The topic that is named, or the only one of that role. Of one topic packed and not, the latter."""
    if named == "":
        return ""
    if named is not None:
        found = next((its for its in topics if its.name == named), None)
        if found is None:
            raise InvalidArgument(f"{role}={named!r}: there is no such topic; there are {_told(topics)}")
        if type_of(found) not in _TYPES[role] or found.encoding != "cdr":
            raise InvalidArgument(f"{role}={named!r} is of {found.type} ({found.encoding}); wanted "
                                  f"{' or '.join(_TYPES[role])} (cdr)")
        return named
    fitting = [its for its in topics if role_of(its) == role and its.num_messages > 0]
    unpacked = [its for its in fitting if type_of(its) != COMPRESSED_IMAGE]
    best = unpacked or fitting
    if len(best) > 1:
        raise InvalidArgument(f"several topics may be {role}: {', '.join(its.name for its in best)}: say which by "
                              f"{role}=, or none by {role}=''")
    return best[0].name if best else ""


def _camera_info(topics: Sequence[Topic], image: str, named: str | None) -> str:
    """That beside the images, up to two levels above."""
    if named:
        return _one("camera_info", topics, named)
    infos = {its.name for its in topics if role_of(its) == "camera_info"}
    parent = image
    for _ in range(3):
        parent = parent.rpartition("/")[0]
        if f"{parent}/camera_info" in infos:
            return f"{parent}/camera_info"
    raise InvalidArgument(f"no camera_info lies beside {image}: say camera_info=; there are "
                          f"{', '.join(sorted(infos)) or 'none'}")


def _told(topics: Iterable[Topic]) -> str:
    return ", ".join(f"{its.name} ({its.type})" for its in topics) or "none"
