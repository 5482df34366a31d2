// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/pipeline/assigned_parts.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace dhpmap {
namespace {

/// The parts of a segment that a submap shares with others: whether it has own parts, and the others' parts.
struct SharedSegment {
  bool has_own = false;
  std::vector<const SegmentBundles*> others;
};

/// Keyed by segment id.
std::map<std::uint32_t, SharedSegment> FindShared(const PanopticFrame& frame,
                                                  const std::vector<SegmentBundles>& segments,
                                                  std::span<const std::size_t> own) {
  std::map<std::uint32_t, SharedSegment> shared;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (segments[s].row < 0) continue;
    SharedSegment& segment = shared[frame.segments[static_cast<std::size_t>(segments[s].row)].id.value];
    if (std::binary_search(own.begin(), own.end(), s)) segment.has_own = true;
    else segment.others.push_back(&segments[s]);
  }
  std::erase_if(shared, [](const auto& entry) { return !entry.second.has_own || entry.second.others.empty(); });
  return shared;
}

/// Whether the voxel belongs to another submap's part. Each voxel of a segment is in one part; rounding may have
/// bundled a point on a face into either neighbour, so it counts for the others only if one of their parts ends in the
/// voxel.
bool IsOfOthers(const SharedSegment& segment, VoxelIndex voxel) {
  return std::any_of(segment.others.begin(), segment.others.end(),
                     [voxel](const SegmentBundles* part) { return part->EndsIn(voxel); });
}

/// Calls visit(point, function that returns its position in the map frame) for all points of a frame with a return.
template <typename Visitor>
void VisitPoints(const PanopticFrame& frame, Visitor&& visit) {
  if (frame.lidar) {
    for (std::size_t i = 0; i < frame.lidar->points_m.size(); ++i) {
      visit(i, [&] { return Eigen::Vector3d(frame.T_map_sensor * frame.lidar->points_m[i].cast<double>()); });
    }
    return;
  }
  const PinholeCamera& camera = frame.camera->camera;
  std::size_t i = 0;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u, ++i) {
      const double depth_m = frame.camera->depth_m[i];
      if (!std::isfinite(depth_m) || depth_m <= 0) continue;
      visit(i, [&] {
        const Eigen::Vector3d ray((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1.0);
        return Eigen::Vector3d(frame.T_map_sensor * (depth_m * ray));
      });
    }
  }
}

}  // namespace

std::optional<PanopticFrame> WithoutPartsOfOthers(const PanopticFrame& frame,
                                                  const std::vector<SegmentBundles>& segments,
                                                  std::span<const std::size_t> own, double voxel_size_m) {
  const std::map<std::uint32_t, SharedSegment> shared = FindShared(frame, segments, own);
  if (shared.empty()) return std::nullopt;
  std::optional<PanopticFrame> rest(frame);
  std::vector<std::uint32_t>& ids = rest->lidar ? rest->lidar->segments : rest->camera->segments;
  VisitPoints(frame, [&](std::size_t i, const auto& position_m) {
    const auto segment = shared.find(ids[i]);
    if (segment == shared.end()) return;
    if (IsOfOthers(segment->second, VoxelAt(position_m(), voxel_size_m))) ids[i] = kNoSegment.value;
  });
  return rest;
}

}  // namespace dhpmap
