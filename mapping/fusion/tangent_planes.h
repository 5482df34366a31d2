// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/fusion/moment_pyramid.h"
#include "mapping/fusion/segment_bundles.h"
#include "mapping/fusion/wide_planes.h"

namespace dhpmap {

/// How a sensor's points lie on a surface.
enum class PointSpacing {
  kDense,  ///< a depth image: from voxel to voxel, so that the bands of neighbouring rays meet
  kScan    ///< a LiDAR: on rings, apart by more the more the rays graze
};

/// Scratch memory for fitting planes, reused between segments. Not thread-safe.
struct TangentPlaneRoom {
  MomentPyramid pyramid;
  WidePlanes wide;

  [[nodiscard]] std::size_t BufferBytes() const { return pyramid.BufferBytes() + wide.BufferBytes(); }
};

/// Lays a plane through what was seen around each bundle and writes it to Bundle::plane. It goes through the weighted
/// mean of the means of the segment's bundles in a window of 4^3 voxels, across their smallest principal axis. A window
/// is that of all bundles in its inner 2^3 voxels, so it is fitted once for these. Where it holds too few bundles, or
/// these are in a line, so is one of 8^3 and then 16^3 voxels. If there is no plane (too few, too thick, seen nearly
/// edge on, not through the bundle) it is that across the ray through the bundle's end, to which the distance is that
/// along the ray.
/// Where points of a scan are still in a line, so are those of wider windows (WidePlanes): a road's rings lie metres
/// apart. With points of a scan the plane also says how far along the ray there are others in it (before_m, behind_m).
/// Depends on the segment's bundles alone and adds them up in their order. Segments may be done at once, with a room
/// each to work in.
void FitTangentPlanes(double voxel_size_m, PointSpacing spacing, TangentPlaneRoom& room, SegmentBundles& segment);

}  // namespace dhpmap
