// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/bundler.h"

#include "mapping/fusion/bundle_cells.h"
#include "mapping/fusion/sorted_runs.h"
#include "mapping/fusion/tangent_planes.h"

namespace dhpmap {

Bundler::Bundler(const IntegrationConfig& config, ThreadPool& pool) : config_(config), pool_(pool) {}
Bundler::~Bundler() = default;

void Bundler::BundleSegments(const PanopticFrame& frame, double voxel_size_m, FrameTally& tally) {
  const std::vector<RunsOfSegment> ranges = SortRunsBySegment(frame.segments, bands_, sorted_runs_);
  segments_.resize(ranges.size());
  for (std::size_t s = 0; s < ranges.size(); ++s) {
    segments_[s].Reset();
    segments_[s].row = ranges[s].row;
  }
  pool_.ParallelFor(ranges.size(), [&](std::size_t s) {
    const std::span runs(sorted_runs_.data() + ranges[s].begin, ranges[s].end - ranges[s].begin);
    BundleRuns(runs, tally, segments_[s]);
  });
  if (tally.is_too_large()) return;
  pool_.ParallelFor(segments_.size(), [&](std::size_t s) {
    FitTangentPlanes(voxel_size_m, frame.lidar ? PointSpacing::kScan : PointSpacing::kDense, segments_[s]);
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
  std::size_t bytes = CapacityBytes(bands_) + CapacityBytes(sorted_runs_) + CapacityBytes(segments_);
  for (const std::vector<PointRun>& runs : bands_) bytes += CapacityBytes(runs);
  for (const SegmentBundles& segment : segments_) bytes += segment.BufferBytes();
  return bytes;
}

void Bundler::GiveBuffersBack() noexcept {
  bands_ = RunBands();
  sorted_runs_ = std::vector<const PointRun*>();
  segments_ = std::vector<SegmentBundles>();
  counted_.Set(0);
}

}  // namespace dhpmap
