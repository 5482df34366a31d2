# SPDX-License-Identifier: BSD-3-Clause
"""What may be said of a recording."""
from __future__ import annotations

from collections.abc import Mapping
from typing import TypedDict


class FrameOptions(TypedDict, total=False):
    """How frames are made of a recording. Topics that are not named are told from their types and names; "": none.

    Attributes:
        depth: of depth images; or cloud: of clouds, instead.
        color, camera_info: of images of the depth images' size and frame, and of their camera. Beside a cloud, images
            of one camera if they are named: the cloud's points that it does not show are dropped, the others take
            their colours and labels from it.
        labels: of label images of that size, an integer a pixel. Of a cloud: give this or label_field.
        label_field: the integer field of a cloud that holds labels, such as "label".
        label_table: what ids are: of vision_msgs/LabelInfo (classes), or of vision_msgs/Detection2DArray (a segment a
            detection, whose id is the pixels' value).
        classes: names of classes by id, in place of a LabelInfo's, or as well as detections.
        label_divisor: ids are class * divisor + number of the thing, such as 1000; 0: ids are classes.
        map_frame: the frame of /tf that is the map's; z up.
        tolerance_s: between the stamps of images that belong together.
        max_gap_s: between transforms of which one between is made.
        skip_gaps: frames without a transform are left out, rather than an error.
        rectified: images are rectified: P of the camera info holds, and its distortion is done with.
        off_centre: the principal point may lie far from the middle of the image.
    """

    depth: str
    cloud: str
    color: str
    camera_info: str
    labels: str
    label_field: str
    label_table: str
    classes: Mapping[int, str]
    label_divisor: int
    map_frame: str
    tolerance_s: float
    max_gap_s: float
    skip_gaps: bool
    rectified: bool
    off_centre: bool
