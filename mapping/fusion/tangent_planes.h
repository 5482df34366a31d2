// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/fusion/moment_pyramid.h"
#include "mapping/fusion/segment_bundles.h"
#include "mapping/fusion/wide_planes.h"

namespace dhpmap {

/// The distribution of a sensor's points on a surface.
enum class PointSpacing {
  kDense,  ///< a depth image: a point in every voxel, so the bands of neighbouring rays meet
  kScan    ///< a LiDAR: on rings, whose distance grows with the angle of incidence
};

/// Scratch memory for fitting planes, reused between segments. Not thread-safe.
struct TangentPlaneRoom {
  MomentPyramid pyramid;
  WidePlanes wide;

  [[nodiscard]] std::size_t BufferBytes() const { return pyramid.BufferBytes() + wide.BufferBytes(); }
};

/// Fits a plane to the surroundings of each bundle and writes it to Bundle::plane. The plane goes through the weighted
/// mean of the bundles in a window of 4^3 voxels, across their smallest principal axis. All bundles in the inner 2^3
/// voxels share the window and its plane. If the window holds too few bundles, or they are on a line, windows of 8^3
/// and then 16^3 voxels follow. If there is no plane (too few bundles, too thick, seen nearly edge on, off the bundle),
/// Bundle::plane is perpendicular to the ray at the bundle's end; the distance is then that along the ray.
///
/// If points of a scan are on a line in all of these windows, wider ones follow (WidePlanes): a road's rings lie metres
/// apart. With points of a scan the plane also records how far along the ray it has other points (before_m, behind_m).
/// The result depends only on the segment's bundles and sums them in order. Segments may run in parallel, with a room
/// each.
void FitTangentPlanes(double voxel_size_m, PointSpacing spacing, TangentPlaneRoom& room, SegmentBundles& segment);

}  // namespace dhpmap
