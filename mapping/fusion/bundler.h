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

/// Groups the points of a frame by segment and end voxel. Reuses its buffers, except those of a frame with too many
/// cells or a failure. They count as MemoryKind::kFusion. Thread-compatible.
class Bundler {
 public:
  Bundler(const IntegrationConfig& config, ThreadPool& pool);
  ~Bundler();

  /// Bundles every valid point in range, on the grid of `voxel_size_m` in the frame of `T_grid_sensor`. The result
  /// holds only segments with points: first the unknown object, then by table row. It is valid until the next call, the
  /// same for any number of threads, and the caller may change it. The frame must be valid (ValidateFrame). A frame
  /// with more than kMaxBlocksAFrame cells gives CutShortSegments, without allocating more cells.
  std::vector<SegmentBundles>& BundleFrame(const PanopticFrame& frame, const Transform& T_grid_sensor,
                                           double voxel_size_m);
  /// Frees all buffers, and with them the last result.
  void GiveBuffersBack() noexcept;

 private:
  /// A thread's scratch memory for a segment.
  struct alignas(kCacheLineBytes) Room {
    std::vector<std::uint32_t> cell_of;
    TangentPlaneRoom planes;
  };

  void BundleSegments(const PanopticFrame& frame, double voxel_size_m, FrameTally& tally);
  /// Assigns an empty segment to each; segments with the most runs get the largest buffers of the last frame.
  void HandOutSegments(const std::vector<RunsOfSegment>& ranges, std::span<const std::size_t> by_size);
  [[nodiscard]] std::size_t BufferBytes() const;

  IntegrationConfig config_;
  ThreadPool& pool_;
  std::vector<std::vector<PointRun>> bands_;  ///< RunBands
  std::vector<std::uint32_t> positions_;
  std::vector<const PointRun*> sorted_runs_;
  std::vector<Room> rooms_;
  std::vector<SegmentBundles> segments_;
  CountedBytes counted_{MemoryKind::kFusion};  ///< size of the buffers after the last frame
};

}  // namespace dhpmap
