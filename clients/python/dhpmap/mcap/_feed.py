# SPDX-License-Identifier: BSD-3-Clause
"""A recording goes into a map."""
from __future__ import annotations

import itertools
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Unpack

from dhpmap.mcap._frame import RgbdFrame
from dhpmap.mcap._frames import Frames
from dhpmap.mcap._options import FrameOptions

if TYPE_CHECKING:
    from dhpmap._map import Map


@dataclass(frozen=True, slots=True)
class Fed:
    """What became of a recording.

    Attributes:
        num_frames: that the server has stored, or refused.
        num_refused: of these, by the server.
        num_unmatched, num_without_pose: left out before, for want of an image, or of a transform.
    """

    num_frames: int
    num_refused: int
    num_unmatched: int
    num_without_pose: int


def feed_mcap(target: Map, path: str | os.PathLike[str], session: str, *, persistent_ids: bool, take_over: bool,
              refuse_implausible: bool, progress: bool, **options: Unpack[FrameOptions]) -> Fed:
    frames = Frames(path, **options)
    made = iter(frames)
    first = next(made, None)
    if first is None:
        return Fed(0, 0, frames.num_unmatched, frames.num_without_pose)
    camera, scale_m = (first.camera, first.depth_scale_m) if isinstance(first, RgbdFrame) else (None, None)
    with target.feed(session, camera=camera, depth_scale_m=scale_m, persistent_ids=persistent_ids, take_over=take_over,
                     refuse_implausible=refuse_implausible, progress=progress and frames.num_expected) as feed:
        for frame in itertools.chain((first,), made):
            frame.feed_to(feed)
    return Fed(feed.num_sent, feed.num_refused, frames.num_unmatched, frames.num_without_pose)
