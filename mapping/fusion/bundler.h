// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/base/cache_line.h"
#include "mapping/base/memory_count.h"
#include "mapping/base/thread_pool.h"
#include "mapping/base/transform.h"
#include "mapping/fusion/segment_bundles.h"
#include "mapping/fusion/tangent_planes.h"
#include "mapping/map/map_config.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

class FrameTally;
struct PointRun;
struct RunsOfSegment;

/// Groups the points of a frame by segment and end voxel. Keeps its buffers from frame to frame, but for those of a
/// frame that has too many cells or that failed; they are counted as MemoryKind::kFusion. Thread-compatible.
class Bundler {
 public:
  Bundler(const IntegrationConfig& config, ThreadPool& pool);
  ~Bundler();

  /// Every valid point in range, on the grid of `voxel_size_m` to which `T_grid_sensor` leads. The result holds only
  /// segments with points, first that of unknown objects, then by table row; it stays valid until the next call. The
  /// same for any number of threads, and the caller's to change. The frame must be valid (ValidateFrame). Of one with
  /// more than kMaxBlocksAFrame cells, CutShortSegments: no more cells than these are made, and all are freed again.
  std::vector<SegmentBundles>& BundleFrame(const PanopticFrame& frame, const Transform& T_grid_sensor,
                                           double voxel_size_m);
  /// All memory it keeps from frame to frame; the last result goes with it.
  void GiveBuffersBack() noexcept;

 private:
  /// What a thread works on a segment with.
  struct alignas(kCacheLineBytes) Room {
    std::vector<std::uint32_t> cell_of;
    TangentPlaneRoom planes;
  };

  void BundleSegments(const PanopticFrame& frame, double voxel_size_m, FrameTally& tally);
  /// An empty segment each; those with the most runs in what held the largest of the last frame.
  void HandOutSegments(const std::vector<RunsOfSegment>& ranges, std::span<const std::size_t> by_size);
  [[nodiscard]] std::size_t BufferBytes() const;

  IntegrationConfig config_;
  ThreadPool& pool_;
  std::vector<std::vector<PointRun>> bands_;  ///< RunBands
  std::vector<std::uint32_t> positions_;
  std::vector<const PointRun*> sorted_runs_;
  std::vector<Room> rooms_;
  std::vector<SegmentBundles> segments_;
  CountedBytes counted_{MemoryKind::kFusion};  ///< the buffers, as they were after the last frame
};

}  // namespace dhpmap
