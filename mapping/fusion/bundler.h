// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "mapping/base/grid.h"
#include "mapping/base/ids.h"
#include "mapping/base/thread_pool.h"
#include "mapping/base/transform.h"
#include "mapping/map/map_config.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

struct RowPoints;

/// The surface where a bundle ends: what lies at p, relative to the sensor's origin and along the axes of the grid, is
/// normal * p + offset_m before it (negative: behind).
struct TangentPlane {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, towards the sensor
  float offset_m = 0;                                ///< of the sensor
  float before_m = 0, behind_m = 0;                  ///< how far along the ray, about the end, it was seen
};

/// The points of one segment that end in the same voxel, to be traced as one ray (paper II-C). Positions are relative
/// to the sensor's origin, along the axes of the grid.
struct Bundle {
  Eigen::Vector3f weighted_sum_m = Eigen::Vector3f::Zero();
  float weight = 0;
  Eigen::Vector3f weighted_color = Eigen::Vector3f::Zero();
  std::uint32_t num_points = 0;
  TangentPlane plane;        ///< see FitTangentPlanes
  std::uint16_t linear = 0;  ///< its end voxel, in the cell's block
};

/// The bundles of one segment that end in one block.
struct BundleCell {
  BlockIndex block;
  std::uint32_t first_bundle = 0;
  std::uint32_t num_bundles = 0;
  /// For each voxel of the block, 1 + the bundle that ends there, counted from first_bundle; 0 = none.
  std::array<std::uint16_t, kBlockVoxels> slot{};
};

/// One segment of a frame, bundled on a grid.
class SegmentBundles {
 public:
  /// Row of the frame's segment table, or -1 for points of no known object.
  int row = -1;
  /// Of a frame that has more than kMaxBlocksAFrame cells, which must be refused: nothing else of it is here.
  bool is_cut_short = false;
  std::int64_t num_points = 0;
  std::vector<BundleCell> cells;
  std::vector<Bundle> bundles;

  /// Null if no bundle ends in that block.
  [[nodiscard]] const BundleCell* Find(BlockIndex block) const;
  [[nodiscard]] bool EndsIn(VoxelIndex voxel) const;

  /// May invalidate references to cells.
  BundleCell& FindOrInsert(BlockIndex block);

 private:
  friend class Bundler;
  void Reset();
  std::vector<std::uint32_t> slots_;  // open addressing over cells, 1 + index, 0 = free
};

/// What is left of a frame that has too many cells: a segment of unknown objects and one a table row, all cut short.
std::vector<SegmentBundles> CutShortSegments(std::size_t num_rows);

/// Groups the points of a frame by segment and end voxel. Keeps its buffers from frame to frame, but for those of a
/// frame that has too many cells or that failed. Thread-compatible.
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
  struct Run;
  struct Grid;
  class Tally;
  static void CombineRow(const RowPoints& points, const std::uint32_t* segments, const Color* colors, std::size_t width,
                         std::vector<Run>& runs);
  void CollectCameraRuns(const DepthCameraData& data, const Grid& grid, Tally& tally);
  void CollectLidarRuns(const LidarData& data, const Grid& grid, Tally& tally);
  void SortRunsBySegment(const PanopticFrame& frame, double voxel_size_m, Tally& tally);
  void BuildSegment(std::size_t begin, std::size_t end, SegmentBundles& segment, Tally& tally);

  IntegrationConfig config_;
  ThreadPool& pool_;
  std::vector<std::vector<Run>> bands_;
  std::vector<const Run*> sorted_runs_;
  std::vector<SegmentBundles> segments_;
};

}  // namespace dhpmap
