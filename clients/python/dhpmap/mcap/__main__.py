# SPDX-License-Identifier: BSD-3-Clause
"""Says what is in a recording of ROS 2 in an MCAP file, or feeds it into a map."""
from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import Any

import dhpmap
from dhpmap.mcap._options import FrameOptions
from dhpmap.mcap._recording import Recording
from dhpmap.mcap._topics import choose, role_of

TEXTS = {"depth": "topic of depth images", "cloud": "topic of clouds, instead", "color": "topic of colour images",
         "camera_info": "topic of the depth images' camera", "labels": "topic of label images",
         "label_field": "integer field of a cloud that holds labels",
         "label_table": "topic of vision_msgs/LabelInfo or Detection2DArray: what the labels are",
         "map_frame": "frame of /tf that is the map's (map)"}
NUMBERS = {"label_divisor": (int, "labels are class * N + number of the thing (0: classes)"),
           "tolerance_s": (float, "between stamps of images that belong together (0.02)"),
           "max_gap_s": (float, "between transforms (0.5)")}
FLAGS = {"skip_gaps": "leave frames without a transform out, rather than stop",
         "rectified": "images are rectified: P of the camera info holds", "off_centre": "of cropped images"}


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("python3 -m dhpmap.mcap", description=__doc__)
    parser.add_argument("file", help="an .mcap file, or a folder of them")
    parser.add_argument("--info", action="store_true", help="list topics, types, counts, and what each is taken for")
    parser.add_argument("--map", help="feed it into this map")
    parser.add_argument("--server", default="localhost:50051", help="address (%(default)s)")
    parser.add_argument("--token-file", metavar="FILE", help="file with your key, of mode 600")
    parser.add_argument("--ca", metavar="FILE", help="PEM file of who signed the server's certificate, or 'system' for "
                        "those this system trusts: with TLS")
    parser.add_argument("--session", default="mcap", help="name of the robot (%(default)s)")
    parser.add_argument("--label-set", choices=dhpmap.label_sets(), help="make the map if there is none, with these "
                        "classes; label images without a table hold its ids")
    parser.add_argument("--network-ids", action="store_true", help="the label set's classes as networks number them")
    parser.add_argument("--persistent-ids", action="store_true", help="an id is the same object in all frames")
    for name, text in TEXTS.items():
        parser.add_argument(f"--{name.replace('_', '-')}", help=text)
    for name, (kind, text) in NUMBERS.items():
        parser.add_argument(f"--{name.replace('_', '-')}", type=kind, metavar="N", help=text)
    for name, text in FLAGS.items():
        parser.add_argument(f"--{name.replace('_', '-')}", action="store_true", help=text)
    return parser


def _frame_options(given: argparse.Namespace) -> FrameOptions:
    names = (*TEXTS, *NUMBERS, *FLAGS)
    options: Any = {name: value for name in names if (value := getattr(given, name)) not in (None, False)}
    chosen: FrameOptions = options
    return chosen


def _tell(recording: Recording, options: FrameOptions) -> None:
    width = max((len(its.name) for its in recording.topics), default=0)
    for its in recording.topics:
        print(f"{its.name:<{width}}  {its.num_messages:>7}  {its.type} ({its.encoding})  {role_of(its) or '-'}")
    try:
        chosen = choose(recording.topics, options)
    except dhpmap.InvalidArgument as error:
        print(f"as it stands it cannot be fed: {error}")
        return
    said = {"cloud" if chosen.is_cloud else "depth": chosen.lead, "color": chosen.color, "labels": chosen.labels,
            "label_table": chosen.label_table, "camera_info": chosen.camera_info,
            "transforms": ", ".join(chosen.transforms)}
    print("it would be fed from", ", ".join(f"{role} {topic}" for role, topic in said.items() if topic))


def _feed(given: argparse.Namespace, options: FrameOptions) -> None:
    numbered: Any = "network" if given.network_ids else "data_set"
    classes = dhpmap.label_set(given.label_set, ids=numbered) if given.label_set else []
    if classes and not given.label_table:
        options["classes"] = {its.id: its.name for its in classes}
    secured: Any = {"tls": True} if given.ca == "system" else {"ca": given.ca} if given.ca else {}
    if given.token_file:
        secured["token_file"] = given.token_file
    with dhpmap.connect(given.server, **secured) as server:
        if given.map not in server and given.label_set:
            target = server.create(given.map, classes, preset="outdoor_lidar" if given.cloud else "indoor")
        else:
            target = server[given.map]
        fed = target.feed_mcap(given.file, given.session, persistent_ids=given.persistent_ids, progress=True, **options)
        print(f"{fed}; {target}")


def main(arguments: Sequence[str] | None = None) -> int:
    parser = _parser()
    given = parser.parse_args(arguments)
    if not (given.info or given.map):
        parser.error("say --info or --map NAME")
    try:
        options = _frame_options(given)
        if given.info:
            _tell(Recording(given.file), options)
        if given.map:
            _feed(given, options)
    except (dhpmap.Error, OSError) as error:
        print(f"dhpmap.mcap: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
