// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/bundler.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <unordered_map>

#include "mapping/fusion/band_size.h"
#include "mapping/fusion/point_kernel.h"
#include "mapping/fusion/tangent_planes.h"

namespace dhpmap {
namespace {

// Sizes of the parts that are worked on in parallel: fixed, so that the result does not depend on the thread count.
constexpr int kRowsPerBand = 16;
constexpr std::size_t kPointsPerBand = 4096;

std::size_t NextPowerOfTwo(std::size_t n) {
  std::size_t power = 16;
  while (power < n) power *= 2;
  return power;
}

std::size_t SlotHash(BlockIndex block, std::size_t mask) { return BlockIndexHash{}(block)&mask; }

Color ColorAt(const std::vector<Color>& colors, std::size_t i) {
  return colors.empty() ? Color{128, 128, 128} : colors[i];
}

}  // namespace

/// Consecutive points of one segment in one voxel, summed up.
struct Bundler::Run {
  std::uint32_t segment;
  VoxelIndex voxel;
  std::uint32_t num_points = 0;
  float weight = 0;
  Eigen::Vector3f weighted_sum_m = Eigen::Vector3f::Zero();
  Eigen::Vector3f weighted_color = Eigen::Vector3f::Zero();

  void Add(const Eigen::Vector3f& p_m, float w, Color c) {
    ++num_points;
    weight += w;
    weighted_sum_m += w * p_m;
    weighted_color += w * Eigen::Vector3f(c.r, c.g, c.b);
  }
};

/// How large a frame turns out to be while it is taken apart. Thread-safe. How much of a frame was seen when it is
/// found too large depends on the threads; whether it is found too large does not.
class Bundler::Tally {
 public:
  /// A frame of so few points cannot have too many cells before its cells are made.
  explicit Tally(std::size_t num_points) : blocks_seen_(num_points > kMaxBlocksAFrame ? kNumWords : 0) {}

  [[nodiscard]] bool is_too_large() const { return is_too_large_.load(std::memory_order_relaxed); }

  /// Before the cells are counted one by one: enough blocks mean enough cells, so that most runs of a frame of noise
  /// are never made. Costs nothing until there are as many runs as there may be cells.
  void NoteRuns(const std::vector<Run>& runs);

  /// Before a cell is made; false: it must not be.
  [[nodiscard]] bool TakeCell() {
    if (num_cells_.fetch_add(1, std::memory_order_relaxed) < kMaxBlocksAFrame) return true;
    is_too_large_.store(true, std::memory_order_relaxed);
    return false;
  }

 private:
  static constexpr std::size_t kWordBits = 64;
  static constexpr std::size_t kNumWords = 16 * kMaxBlocksAFrame / kWordBits;  // 256 kB: 3 % of the blocks share a bit

  /// Linear counting: a bit a block, by its hash. Blocks that share one count once, so the sum is never too large.
  [[nodiscard]] bool IsNew(BlockIndex block) {
    const std::size_t bit = SlotHash(block, kNumWords * kWordBits - 1);
    std::atomic<std::uint64_t>& word = blocks_seen_[bit / kWordBits];
    const std::uint64_t mask = std::uint64_t{1} << bit % kWordBits;
    if ((word.load(std::memory_order_relaxed) & mask) != 0) return false;
    return (word.fetch_or(mask, std::memory_order_relaxed) & mask) == 0;
  }

  std::vector<std::atomic<std::uint64_t>> blocks_seen_;
  std::atomic<std::size_t> num_runs_ = 0, num_blocks_ = 0, num_cells_ = 0;
  std::atomic<bool> is_too_large_ = false;
};

void Bundler::Tally::NoteRuns(const std::vector<Run>& runs) {
  if (num_runs_.fetch_add(runs.size(), std::memory_order_relaxed) + runs.size() <= kMaxBlocksAFrame) return;
  std::size_t num_new = 0;
  const Run* last = nullptr;
  for (const Run& run : runs) {
    if (last == nullptr || BlockOf(last->voxel) != BlockOf(run.voxel)) num_new += IsNew(BlockOf(run.voxel));
    last = &run;
  }
  if (num_blocks_.fetch_add(num_new, std::memory_order_relaxed) + num_new > kMaxBlocksAFrame) {
    is_too_large_.store(true, std::memory_order_relaxed);
  }
}

/// The sensor on the grid: axes, and the origin split into its voxel and the rest, so that single precision holds the
/// millimetre at any distance from the map's origin.
struct Bundler::Grid {
  Eigen::Matrix3f R_grid_sensor;
  float voxels_per_m;
  VoxelIndex base;
  Eigen::Vector3f offset_vox;

  Grid(const Transform& T_grid_sensor, double voxel_size_m)
      : R_grid_sensor(T_grid_sensor.linear().cast<float>()), voxels_per_m(static_cast<float>(1.0 / voxel_size_m)) {
    base = VoxelAt(T_grid_sensor.translation(), voxel_size_m);
    offset_vox = (T_grid_sensor.translation() / voxel_size_m - Eigen::Vector3d(base.x, base.y, base.z)).cast<float>();
  }

  [[nodiscard]] VoxelIndex VoxelOf(const Eigen::Vector3f& p_m) const {
    const Eigen::Vector3f v = p_m * voxels_per_m + offset_vox;
    return {base.x + static_cast<std::int32_t>(std::floor(v.x())),
            base.y + static_cast<std::int32_t>(std::floor(v.y())),
            base.z + static_cast<std::int32_t>(std::floor(v.z()))};
  }
};

Bundler::Bundler(const IntegrationConfig& config, ThreadPool& pool) : config_(config), pool_(pool) {}
Bundler::~Bundler() = default;

const BundleCell* SegmentBundles::Find(BlockIndex block) const {
  if (slots_.empty()) return nullptr;
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t slot = SlotHash(block, mask); slots_[slot] != 0; slot = (slot + 1) & mask) {
    if (cells[slots_[slot] - 1].block == block) return &cells[slots_[slot] - 1];
  }
  return nullptr;
}

bool SegmentBundles::EndsIn(VoxelIndex voxel) const {
  const BundleCell* cell = Find(BlockOf(voxel));
  return cell != nullptr && cell->slot[static_cast<std::size_t>(LinearIndex(voxel))] != 0;
}

BundleCell& SegmentBundles::FindOrInsert(BlockIndex block) {
  if (2 * (cells.size() + 1) > slots_.size()) {
    slots_.assign(NextPowerOfTwo(4 * (cells.size() + 1)), 0);
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      std::size_t slot = SlotHash(cells[i].block, mask);
      while (slots_[slot] != 0) slot = (slot + 1) & mask;
      slots_[slot] = static_cast<std::uint32_t>(i + 1);
    }
  }
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = SlotHash(block, mask);
  for (; slots_[slot] != 0; slot = (slot + 1) & mask) {
    if (cells[slots_[slot] - 1].block == block) return cells[slots_[slot] - 1];
  }
  cells.push_back({.block = block});
  slots_[slot] = static_cast<std::uint32_t>(cells.size());
  return cells.back();
}

void SegmentBundles::Reset() {
  row = -1;
  is_cut_short = false;
  num_points = 0;
  cells.clear();
  bundles.clear();
  std::fill(slots_.begin(), slots_.end(), 0);
}

std::vector<SegmentBundles> CutShortSegments(std::size_t num_rows) {
  std::vector<SegmentBundles> segments(num_rows + 1);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    segments[i].row = static_cast<int>(i) - 1;
    segments[i].is_cut_short = true;
  }
  return segments;
}

/// Cuts a row of pixels into runs. The sums stay in registers until a run ends.
void Bundler::CombineRow(const RowPoints& points, const std::uint32_t* segments, const Color* colors, std::size_t width,
                         std::vector<Run>& runs) {
  constexpr float kGrey = 128.0f;
  std::size_t u = 0;
  while (u < width) {
    if (points.weight[u] == 0.0f) {
      ++u;
      continue;
    }
    const std::int32_t x = points.voxel_x[u], y = points.voxel_y[u], z = points.voxel_z[u];
    const std::uint32_t segment = segments ? segments[u] : 0;
    float weight = 0, sum_x = 0, sum_y = 0, sum_z = 0, red = 0, green = 0, blue = 0;
    const std::size_t begin = u;
    do {
      const float w = points.weight[u];
      weight += w;
      sum_x += w * points.x_m[u];
      sum_y += w * points.y_m[u];
      sum_z += w * points.z_m[u];
      if (colors) {
        red += w * static_cast<float>(colors[u].r);
        green += w * static_cast<float>(colors[u].g);
        blue += w * static_cast<float>(colors[u].b);
      }
      ++u;
    } while (u < width && points.voxel_x[u] == x && points.voxel_y[u] == y && points.voxel_z[u] == z &&
             points.weight[u] != 0.0f && (segments == nullptr || segments[u] == segment));
    if (colors == nullptr) red = green = blue = kGrey * weight;
    runs.push_back(
        {segment, {x, y, z}, static_cast<std::uint32_t>(u - begin), weight, {sum_x, sum_y, sum_z}, {red, green, blue}});
  }
}

void Bundler::CollectCameraRuns(const DepthCameraData& data, const Grid& grid, Tally& tally) {
  const PinholeCamera& camera = data.camera;
  const auto width = static_cast<std::size_t>(camera.width_px);
  std::vector<float> column(4 * width);
  for (std::size_t u = 0; u < width; ++u) {
    const auto x = static_cast<float>((static_cast<double>(u) - camera.cx_px) / camera.fx_px);
    for (int axis = 0; axis < 3; ++axis)
      column[static_cast<std::size_t>(axis) * width + u] = grid.R_grid_sensor(axis, 0) * x;
    column[3 * width + u] = x * x + 1.0f;
  }
  const auto square = [](double value) { return static_cast<float>(value * value); };
  RowGeometry shared{};
  shared.column_x = column.data();
  shared.column_y = column.data() + width;
  shared.column_z = column.data() + 2 * width;
  shared.column_length2 = column.data() + 3 * width;
  shared.offset_x_vox = grid.offset_vox.x(), shared.offset_y_vox = grid.offset_vox.y(),
  shared.offset_z_vox = grid.offset_vox.z();
  shared.base_x = grid.base.x, shared.base_y = grid.base.y, shared.base_z = grid.base.z;
  shared.voxels_per_m = grid.voxels_per_m;
  shared.min_range2_m2 = square(config_.min_range_m);
  shared.max_range2_m2 = square(config_.max_range_m);
  shared.weighting = config_.weighting;

  bands_.resize(static_cast<std::size_t>((camera.height_px + kRowsPerBand - 1) / kRowsPerBand));
  pool_.ParallelFor(bands_.size(), [&](std::size_t band) {
    std::vector<Run>& runs = bands_[band];
    runs.clear();
    if (tally.is_too_large()) return;
    std::vector<float> values(4 * width);
    std::vector<std::int32_t> voxels(3 * width);
    const RowPoints row_points{
        values.data(), values.data() + width, values.data() + 2 * width, values.data() + 3 * width,
        voxels.data(), voxels.data() + width, voxels.data() + 2 * width};
    const int end_row = std::min(camera.height_px, static_cast<int>(band + 1) * kRowsPerBand);
    for (int v = static_cast<int>(band) * kRowsPerBand; v < end_row; ++v) {
      const auto y = static_cast<float>((v - camera.cy_px) / camera.fy_px);
      RowGeometry geometry = shared;
      geometry.row_x = grid.R_grid_sensor(0, 1) * y + grid.R_grid_sensor(0, 2);
      geometry.row_y = grid.R_grid_sensor(1, 1) * y + grid.R_grid_sensor(1, 2);
      geometry.row_z = grid.R_grid_sensor(2, 1) * y + grid.R_grid_sensor(2, 2);
      geometry.row_length2 = y * y;
      const std::size_t first = static_cast<std::size_t>(v) * width;
      ProjectRow(data.depth_m.data() + first, camera.width_px, geometry, row_points);

      const std::uint32_t* segments = data.segments.empty() ? nullptr : data.segments.data() + first;
      const Color* colors = data.color.empty() ? nullptr : data.color.data() + first;
      CombineRow(row_points, segments, colors, width, runs);
    }
    tally.NoteRuns(runs);
  });
}

void Bundler::CollectLidarRuns(const LidarData& data, const Grid& grid, Tally& tally) {
  const std::size_t num_points = data.points_m.size();
  bands_.resize((num_points + kPointsPerBand - 1) / kPointsPerBand);
  pool_.ParallelFor(bands_.size(), [&](std::size_t band) {
    std::vector<Run>& runs = bands_[band];
    runs.clear();
    if (tally.is_too_large()) return;
    const std::size_t end = std::min(num_points, (band + 1) * kPointsPerBand);
    for (std::size_t i = band * kPointsPerBand; i < end; ++i) {
      const Eigen::Vector3f& p_sensor = data.points_m[i];
      const double range = p_sensor.cast<double>().norm();
      if (!(range >= kLeastDepth_m && range >= config_.min_range_m && range <= config_.max_range_m)) continue;
      float weight = 1.0f;
      if (config_.weighting == Weighting::kInverseRangeSquared) weight = static_cast<float>(1.0 / (range * range));
      if (config_.weighting == Weighting::kInverseDepthSquared) weight = static_cast<float>(1.0 / (range * range));
      const Eigen::Vector3f p_m = grid.R_grid_sensor * p_sensor;
      const VoxelIndex voxel = grid.VoxelOf(p_m);
      const std::uint32_t segment = data.segments.empty() ? 0 : data.segments[i];
      if (runs.empty() || runs.back().voxel != voxel || runs.back().segment != segment) {
        runs.push_back({.segment = segment, .voxel = voxel});
      }
      runs.back().Add(p_m, weight, ColorAt(data.color, i));
    }
    tally.NoteRuns(runs);
  });
}

void Bundler::SortRunsBySegment(const PanopticFrame& frame, double voxel_size_m, Tally& tally) {
  // Position in segments_: 0 for points of no known object, then 1 + row of the table.
  std::unordered_map<std::uint32_t, std::uint32_t> position_of;
  for (std::size_t row = 0; row < frame.segments.size(); ++row) {
    position_of[frame.segments[row].id.value] = static_cast<std::uint32_t>(row + 1);
  }
  std::size_t num_runs = 0;
  for (const auto& runs : bands_) num_runs += runs.size();
  std::vector<std::uint32_t> positions;
  positions.reserve(num_runs);
  std::vector<std::size_t> starts(frame.segments.size() + 2, 0);
  std::uint32_t last_segment = 0, last_position = 0;
  for (const auto& runs : bands_) {
    for (const Run& run : runs) {
      if (run.segment != last_segment) {
        const auto it = position_of.find(run.segment);
        last_segment = run.segment;
        last_position = it == position_of.end() ? 0 : it->second;
      }
      positions.push_back(last_position);
      ++starts[last_position + 1];
    }
  }
  for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];

  sorted_runs_.resize(num_runs);
  std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
  std::size_t i = 0;
  for (const auto& runs : bands_) {
    for (const Run& run : runs) sorted_runs_[next[positions[i++]]++] = &run;
  }

  std::size_t num_segments = 0;
  std::vector<std::pair<std::size_t, std::size_t>> ranges;
  for (std::size_t position = 0; position + 1 < starts.size(); ++position) {
    if (starts[position] == starts[position + 1]) continue;
    ranges.emplace_back(starts[position], starts[position + 1]);
    if (segments_.size() <= num_segments) segments_.emplace_back();
    segments_[num_segments].Reset();
    segments_[num_segments++].row = static_cast<int>(position) - 1;
  }
  segments_.resize(num_segments);
  pool_.ParallelFor(num_segments,
                    [&](std::size_t s) { BuildSegment(ranges[s].first, ranges[s].second, segments_[s], tally); });
  if (tally.is_too_large()) return;
  pool_.ParallelFor(num_segments, [&](std::size_t s) {
    FitTangentPlanes(voxel_size_m, frame.lidar ? PointSpacing::kScan : PointSpacing::kDense, segments_[s]);
  });
}

/// Leaves the segment half built where there are too many cells.
void Bundler::BuildSegment(std::size_t begin, std::size_t end, SegmentBundles& segment, Tally& tally) {
  if (tally.is_too_large()) return;
  // First count the bundles of each cell, so that they can lie together; then sum the runs up.
  std::vector<std::uint32_t> cell_of(end - begin);
  BlockIndex last_block{};
  std::uint32_t last_cell = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const BlockIndex block = BlockOf(sorted_runs_[i]->voxel);
    if (i == begin || block != last_block) {
      const BundleCell* found = segment.Find(block);
      if (found == nullptr) {
        if (!tally.TakeCell()) return;
        found = &segment.FindOrInsert(block);
      }
      last_cell = static_cast<std::uint32_t>(found - segment.cells.data());
      last_block = block;
    }
    cell_of[i - begin] = last_cell;
    BundleCell& cell = segment.cells[last_cell];
    std::uint16_t& slot = cell.slot[static_cast<std::size_t>(LinearIndex(sorted_runs_[i]->voxel))];
    if (slot == 0) slot = static_cast<std::uint16_t>(++cell.num_bundles);
  }
  std::uint32_t num_bundles = 0;
  for (BundleCell& cell : segment.cells) {
    cell.first_bundle = num_bundles;
    num_bundles += cell.num_bundles;
  }
  segment.bundles.resize(num_bundles);
  for (std::size_t i = begin; i < end; ++i) {
    const Run& run = *sorted_runs_[i];
    const BundleCell& cell = segment.cells[cell_of[i - begin]];
    const int linear = LinearIndex(run.voxel);
    Bundle& bundle = segment.bundles[cell.first_bundle + cell.slot[static_cast<std::size_t>(linear)] - 1u];
    bundle.linear = static_cast<std::uint16_t>(linear);
    bundle.weighted_sum_m += run.weighted_sum_m;
    bundle.weight += run.weight;
    bundle.weighted_color += run.weighted_color;
    bundle.num_points += run.num_points;
    segment.num_points += run.num_points;
  }
  for (Bundle& bundle : segment.bundles) {
    // Points on all sides of the sensor cancel: in the voxel that it stands in any direction will do.
    const float least = kLeastDepth_m * bundle.weight;
    if (!(bundle.weighted_sum_m.squaredNorm() >= least * least)) bundle.weighted_sum_m = {least, 0, 0};
  }
}

std::vector<SegmentBundles>& Bundler::BundleFrame(const PanopticFrame& frame, const Transform& T_grid_sensor,
                                                  double voxel_size_m) {
  try {
    const Grid grid(T_grid_sensor, voxel_size_m);
    Tally tally(frame.camera ? frame.camera->depth_m.size() : frame.lidar->points_m.size());
    if (frame.camera) {
      CollectCameraRuns(*frame.camera, grid, tally);
    } else {
      CollectLidarRuns(*frame.lidar, grid, tally);
    }
    if (!tally.is_too_large()) SortRunsBySegment(frame, voxel_size_m, tally);
    if (tally.is_too_large()) {
      GiveBuffersBack();
      segments_ = CutShortSegments(frame.segments.size());
    }
  } catch (...) {
    GiveBuffersBack();
    throw;
  }
  return segments_;
}

void Bundler::GiveBuffersBack() noexcept {
  bands_ = std::vector<std::vector<Run>>();
  sorted_runs_ = std::vector<const Run*>();
  segments_ = std::vector<SegmentBundles>();
}

}  // namespace dhpmap
