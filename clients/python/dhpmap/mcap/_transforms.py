# SPDX-License-Identifier: BSD-3-Clause
"""Where frames were at a moment: what /tf and /tf_static have said, interpolated."""
from __future__ import annotations

from bisect import bisect_left, insort
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from dhpmap._errors import DataLoss, OutOfRange
from dhpmap.mcap._messages import Transform

KEEP_S = 60.0  # of what is said of a frame that moves
MOST_SAMPLES = 100_000
MOST_LINKS = 100
UNIT_TOLERANCE = 1e-2  # of the length of a quaternion; the rest is scaled out

Matrix = NDArray[np.float64]


class Gap(OutOfRange):
    """No transform is known at a moment. may_come: nothing after it has been read yet."""

    def __init__(self, message: str, may_come: bool) -> None:
        super().__init__(message, reason="NO_TRANSFORM")
        self.may_come = may_come


class _Sample(NamedTuple):
    stamp_ns: int
    translation_m: NDArray[np.float64]
    xyzw: NDArray[np.float64]


class Transforms:
    """Poses of frames in their parents, the static ones for ever, the others for KEEP_S."""

    def __init__(self, max_gap_s: float) -> None:
        self._max_gap_ns = round(max_gap_s * 1e9)
        self._parents: dict[str, str] = {}
        self._static: dict[str, Matrix] = {}
        self._moving: dict[str, list[_Sample]] = {}

    def add(self, transforms: Iterable[Transform], *, is_static: bool) -> None:
        """Raises DataLoss for a transform that cannot be one."""
        for its in transforms:
            length = float(np.linalg.norm(its.xyzw))
            if not (abs(length - 1) < UNIT_TOLERANCE and np.isfinite(its.translation_m).all()):
                raise DataLoss(f"the transform from {its.child!r} to {its.parent!r} at {its.stamp_ns} is none: "
                               f"quaternion {its.xyzw.tolist()}, translation {its.translation_m.tolist()}")
            if self._parents.setdefault(its.child, its.parent) != its.parent:
                self._parents[its.child] = its.parent  # what was said of the other parent is of no use
                self._moving.pop(its.child, None)
            sample = _Sample(its.stamp_ns, its.translation_m, its.xyzw / length)
            if is_static:
                self._static[its.child] = _matrix(sample.translation_m, sample.xyzw)
            else:
                self._keep(self._moving.setdefault(its.child, []), sample)

    def lookup(self, target: str, source: str, stamp_ns: int) -> Matrix:
        """T_target_source: (4, 4), takes points of source to target. Raises Gap if it is not known at that moment."""
        target, source = target.lstrip("/"), source.lstrip("/")
        ups, downs = self._chain(source), self._chain(target)
        common = next((frame for frame in ups if frame in downs), None)
        if common is None:
            raise Gap(f"no transforms lead from {source!r} to {target!r}: the first goes up to {ups[-1]!r}, the other "
                      f"to {downs[-1]!r}", may_come=True)
        return np.linalg.inv(self._up(downs, common, stamp_ns)) @ self._up(ups, common, stamp_ns)

    @property
    def frames(self) -> list[str]:
        """All that were named."""
        return sorted({*self._parents, *self._parents.values()})

    def _chain(self, frame: str) -> list[str]:
        """The frame, its parent, and so on."""
        chain = [frame]
        while (parent := self._parents.get(chain[-1])) is not None:
            chain.append(parent)
            if len(chain) > MOST_LINKS:
                raise DataLoss(f"the transforms above {frame!r} go in a circle: {', '.join(chain[-4:])}")
        return chain

    def _up(self, chain: list[str], end: str, stamp_ns: int) -> Matrix:
        pose: Matrix = np.eye(4)
        for frame in chain[:chain.index(end)]:
            pose = (self._static[frame] if frame in self._static else self._at(frame, stamp_ns)) @ pose
        return pose

    def _at(self, frame: str, stamp_ns: int) -> Matrix:
        samples, link = self._moving[frame], f"the transform from {frame!r} to {self._parents[frame]!r}"
        index = bisect_left(samples, stamp_ns, key=lambda its: its.stamp_ns)
        if index == len(samples):
            late_s = (stamp_ns - samples[-1].stamp_ns) / 1e9
            raise Gap(f"{link} ends {late_s:.3f} s before stamp {stamp_ns}", may_come=True)
        after = samples[index]
        if after.stamp_ns == stamp_ns:
            return _matrix(after.translation_m, after.xyzw)
        if index == 0:
            early_s = (after.stamp_ns - stamp_ns) / 1e9
            raise Gap(f"{link} begins {early_s:.3f} s after stamp {stamp_ns}", may_come=False)
        before = samples[index - 1]
        if after.stamp_ns - before.stamp_ns > self._max_gap_ns:
            gap_s = (after.stamp_ns - before.stamp_ns) / 1e9
            raise Gap(f"{link} has a gap of {gap_s:.3f} s around stamp {stamp_ns}; at most "
                      f"{self._max_gap_ns / 1e9:g} s (max_gap_s) are interpolated", may_come=False)
        share = (stamp_ns - before.stamp_ns) / (after.stamp_ns - before.stamp_ns)
        return _matrix((1 - share) * before.translation_m + share * after.translation_m,
                       _turned(before.xyzw, after.xyzw, share))

    @staticmethod
    def _keep(samples: list[_Sample], sample: _Sample) -> None:
        if not samples or samples[-1].stamp_ns < sample.stamp_ns:
            samples.append(sample)
        else:
            index = bisect_left(samples, sample.stamp_ns, key=lambda its: its.stamp_ns)
            if samples[index].stamp_ns != sample.stamp_ns:  # said again: the first stands
                insort(samples, sample, key=lambda its: its.stamp_ns)
        oldest_ns = samples[-1].stamp_ns - round(KEEP_S * 1e9)
        if samples[len(samples) // 2].stamp_ns < oldest_ns or len(samples) > MOST_SAMPLES:
            del samples[:len(samples) // 2]  # half at a time, for each deletion moves the others


def _turned(a: NDArray[np.float64], b: NDArray[np.float64], share: float) -> NDArray[np.float64]:
    """Of unit quaternions, along the shorter arc at constant speed."""
    cosine = float(a @ b)
    if cosine < 0:
        b, cosine = -b, -cosine
    angle = float(np.arccos(min(cosine, 1.0)))
    if angle < 1e-6:
        blend = (1 - share) * a + share * b
    else:
        blend = (np.sin((1 - share) * angle) * a + np.sin(share * angle) * b) / np.sin(angle)
    turned: NDArray[np.float64] = blend / np.linalg.norm(blend)
    return turned


def _matrix(translation_m: NDArray[np.float64], xyzw: NDArray[np.float64]) -> Matrix:
    vector, w = xyzw[:3], float(xyzw[3])
    x, y, z = vector
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    pose = np.eye(4)
    pose[:3, :3] += 2 * (w * cross + cross @ cross)  # Rodrigues' formula by half angles
    pose[:3, 3] = translation_m
    return pose
