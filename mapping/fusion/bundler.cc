// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/bundler.h"

#include <algorithm>
#include <utility>

#include "mapping/base/largest_first.h"
#include "mapping/base/scratch_loop.h"
#include "mapping/fusion/bundle_cells.h"
#include "mapping/fusion/sorted_runs.h"
#include "mapping/fusion/tangent_planes.h"

namespace dhpmap {

Bundler::Bundler(const IntegrationConfig& config, ThreadPool& pool) : config_(config), pool_(pool) {}
Bundler::~Bundler() = default;

void Bundler::HandOutSegments(const std::vector<RunsOfSegment>& ranges, std::span<const std::size_t> by_size) {
  std::vector<SegmentBundles> kept = std::exchange(segments_, {});
  std::sort(kept.begin(), kept.end(), [](const SegmentBundles& a, const SegmentBundles& b) {
    return a.bundles.capacity() > b.bundles.capacity();
  });
  segments_.resize(ranges.size());
  for (std::size_t i = 0; i < std::min(kept.size(), ranges.size()); ++i) {
    segments_[by_size[i]] = std::move(kept[i]);
    segments_[by_size[i]].Reset();
  }
  for (std::size_t s = 0; s < ranges.size(); ++s) segments_[s].row = ranges[s].row;
}

void Bundler::BundleSegments(const PanopticFrame& frame, double voxel_size_m, FrameTally& tally) {
  const std::vector<RunsOfSegment> ranges = SortRunsBySegment(frame.segments, bands_, positions_, sorted_runs_);
  std::vector<std::size_t> sizes;
  sizes.reserve(ranges.size());
  for (const RunsOfSegment& range : ranges) sizes.push_back(range.end - range.begin);
  const std::vector<std::size_t> by_size = LargestFirst(sizes);
  HandOutSegments(ranges, by_size);
  ParallelForWithScratch(pool_, ranges.size(), rooms_, [&](std::size_t i, Room& room) {
    const std::size_t s = by_size[i];
    const std::span runs(sorted_runs_.data() + ranges[s].begin, ranges[s].end - ranges[s].begin);
    BundleRuns(runs, tally, room.cell_of, segments_[s]);
  });
  if (tally.is_too_large()) return;
  const PointSpacing spacing = frame.lidar ? PointSpacing::kScan : PointSpacing::kDense;
  ParallelForWithScratch(pool_, segments_.size(), rooms_, [&](std::size_t i, Room& room) {
    FitTangentPlanes(voxel_size_m, spacing, room.planes, segments_[by_size[i]]);
  });
}

std::vector<SegmentBundles>& Bundler::BundleFrame(const PanopticFrame& frame, const Transform& T_grid_sensor,
                                                  double voxel_size_m) {
  try {
    const SensorOnGrid grid(T_grid_sensor, voxel_size_m);
    FrameTally tally(frame.camera ? frame.camera->depth_m.size() : frame.lidar->points_m.size());
    if (frame.camera) {
      CollectCameraRuns(*frame.camera, grid, config_, pool_, tally, bands_);
    } else {
      CollectLidarRuns(*frame.lidar, grid, config_, pool_, tally, bands_);
    }
    if (!tally.is_too_large()) BundleSegments(frame, voxel_size_m, tally);
    if (tally.is_too_large()) {
      GiveBuffersBack();
      segments_ = CutShortSegments(frame.segments.size());
    }
  } catch (...) {
    GiveBuffersBack();
    throw;
  }
  counted_.Set(BufferBytes());
  return segments_;
}

std::size_t Bundler::BufferBytes() const {
  std::size_t bytes = CapacityBytes(bands_) + CapacityBytes(positions_) + CapacityBytes(sorted_runs_) +
                      CapacityBytes(segments_) + CapacityBytes(rooms_);
  for (const std::vector<PointRun>& runs : bands_) bytes += CapacityBytes(runs);
  for (const SegmentBundles& segment : segments_) bytes += segment.BufferBytes();
  for (const Room& room : rooms_) bytes += CapacityBytes(room.cell_of) + room.planes.BufferBytes();
  return bytes;
}

void Bundler::GiveBuffersBack() noexcept {
  bands_ = RunBands();
  positions_ = std::vector<std::uint32_t>();
  sorted_runs_ = std::vector<const PointRun*>();
  rooms_ = std::vector<Room>();
  segments_ = std::vector<SegmentBundles>();
  counted_.Set(0);
}

}  // namespace dhpmap
