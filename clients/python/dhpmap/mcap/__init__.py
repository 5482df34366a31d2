# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of ROS 2 in MCAP files: what is in them, and the frames that a map is fed with.

    import dhpmap.mcap
    for topic in dhpmap.mcap.Recording("walk.mcap").topics:
        print(topic)
    for frame in dhpmap.mcap.frames("walk.mcap", depth="/camera/depth/image"):
        print(frame.stamp_ns, frame.T_map_camera)

Map.feed_mcap feeds them; `python3 -m dhpmap.mcap FILE` does so from a shell. Neither ROS nor the mcap package is
needed; chunks that are packed need python3-lz4 or python3-zstandard, labels that are packed python3-pil.
"""
import os
from typing import Unpack

from dhpmap.mcap._feed import Fed
from dhpmap.mcap._frame import LidarFrame, RgbdFrame
from dhpmap.mcap._frames import Frames
from dhpmap.mcap._options import FrameOptions
from dhpmap.mcap._recording import McapWarning, Message, Recording, Topic
from dhpmap.mcap._transforms import Gap


def frames(path: "str | os.PathLike[str]", **options: Unpack[FrameOptions]) -> Frames:
    """The frames of a recording, by time; help(FrameOptions) says what may be said of it.

    Raises NotFound, DataLoss if it is no MCAP file, InvalidArgument if it is not clear which topics are meant.
    """
    return Frames(path, **options)


__all__ = ["Fed", "FrameOptions", "Frames", "Gap", "LidarFrame", "McapWarning", "Message", "Recording", "RgbdFrame",
           "Topic", "frames"]
