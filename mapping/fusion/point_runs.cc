// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/point_runs.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <utility>

namespace dhpmap {
namespace {

// Sizes of the parts that run in parallel: fixed, so that the result does not depend on the number of threads.
constexpr int kRowsPerBand = 16;
constexpr std::size_t kPointsPerBand = 4096;

/// Finds the run to which a point of a band belongs. Of places with the same hash only the latest is known; an older
/// one starts a new run when it recurs. There is no search, because its branches would be mispredicted.
class KnownRuns {
 public:
  explicit KnownRuns(std::vector<PointRun>& runs) : runs_(runs) {}

  PointRun& At(std::uint32_t number, const PointPlace& place) {
    std::uint32_t& known = known_[number];
    if (known != 0) {
      PointRun& run = runs_[known - 1];
      if (std::memcmp(&run.place, &place, sizeof(place)) == 0) return run;
    }
    runs_.push_back({.place = place});
    known = static_cast<std::uint32_t>(runs_.size());
    return runs_.back();
  }

 private:
  std::vector<PointRun>& runs_;
  std::array<std::uint32_t, std::size_t{1} << kPlaceBits> known_{};  // 1 + index; 0: none
};

/// Scratch memory for a part of a row: short enough for the L1 cache.
struct RowRoom {
  static constexpr std::size_t kWidth = 128;
  std::array<Eigen::Array4f, kWidth> weighted_m, colors;
  std::array<PointPlace, kWidth> places;
  std::array<std::uint32_t, kWidth> numbers;
  [[nodiscard]] RowPoints Points() { return {weighted_m.data()->data(), places.data()->words.data(), numbers.data()}; }
};

/// Sums up pixels.
void AddPixels(const RowRoom& room, std::size_t width, KnownRuns& runs) {
  for (std::size_t u = 0; u < width; ++u) {
    if (room.numbers[u] == RowPoints::kNoPoint) continue;
    PointRun& run = runs.At(room.numbers[u], room.places[u]);
    run.weighted_m += room.weighted_m[u];
    run.weighted_color += room.colors[u];
  }
}

}  // namespace

void CollectCameraRuns(const DepthCameraData& data, const SensorOnGrid& grid, const IntegrationConfig& config,
                       ThreadPool& pool, FrameTally& tally, RunBands& bands) {
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
  shared.min_range2_m2 = square(config.min_range_m);
  shared.max_range2_m2 = square(config.max_range_m);
  shared.weighting = config.weighting;

  static constexpr std::array<std::uint32_t, RowRoom::kWidth> no_segments{};
  bands.resize(static_cast<std::size_t>((camera.height_px + kRowsPerBand - 1) / kRowsPerBand));
  pool.ParallelFor(bands.size(), [&](std::size_t band) {
    bands[band].clear();
    if (tally.is_too_large()) return;
    std::vector<PointRun> runs = std::move(bands[band]);  // see kCacheLineBytes
    RowRoom room;
    KnownRuns known(runs);
    const int end_row = std::min(camera.height_px, static_cast<int>(band + 1) * kRowsPerBand);
    for (int v = static_cast<int>(band) * kRowsPerBand; v < end_row; ++v) {
      const auto y = static_cast<float>((v - camera.cy_px) / camera.fy_px);
      RowGeometry geometry = shared;
      geometry.row_x = grid.R_grid_sensor(0, 1) * y + grid.R_grid_sensor(0, 2);
      geometry.row_y = grid.R_grid_sensor(1, 1) * y + grid.R_grid_sensor(1, 2);
      geometry.row_z = grid.R_grid_sensor(2, 1) * y + grid.R_grid_sensor(2, 2);
      geometry.row_length2 = y * y;
      for (std::size_t u = 0; u < width; u += RowRoom::kWidth) {
        const std::size_t first = static_cast<std::size_t>(v) * width + u;
        const std::size_t num = std::min(RowRoom::kWidth, width - u);
        geometry.column_x = shared.column_x + u, geometry.column_y = shared.column_y + u;
        geometry.column_z = shared.column_z + u, geometry.column_length2 = shared.column_length2 + u;
        const std::uint32_t* segments = data.segments.empty() ? no_segments.data() : data.segments.data() + first;
        const Color* colors = data.color.empty() ? nullptr : data.color.data() + first;
        const RowPoints points = room.Points();
        ProjectRow(data.depth_m.data() + first, segments, static_cast<int>(num), geometry, points);
        WeighColors(colors, points.weighted_m, static_cast<int>(num), room.colors.data()->data());
        AddPixels(room, num, known);
      }
    }
    tally.NoteRuns(runs);
    bands[band] = std::move(runs);
  });
}

void CollectLidarRuns(const LidarData& data, const SensorOnGrid& grid, const IntegrationConfig& config,
                      ThreadPool& pool, FrameTally& tally, RunBands& bands) {
  const std::size_t num_points = data.points_m.size();
  bands.resize((num_points + kPointsPerBand - 1) / kPointsPerBand);
  pool.ParallelFor(bands.size(), [&](std::size_t band) {
    bands[band].clear();
    if (tally.is_too_large()) return;
    std::vector<PointRun> runs = std::move(bands[band]);  // see kCacheLineBytes
    KnownRuns known(runs);
    const std::size_t end = std::min(num_points, (band + 1) * kPointsPerBand);
    for (std::size_t i = band * kPointsPerBand; i < end; ++i) {
      const Eigen::Vector3f& p_sensor = data.points_m[i];
      const double range = p_sensor.cast<double>().norm();
      if (!(range >= kLeastDepth_m && range >= config.min_range_m && range <= config.max_range_m)) continue;
      const float weight = config.weighting == Weighting::kConstant ? 1.0f : static_cast<float>(1.0 / (range * range));
      const Eigen::Vector3f p_m = grid.R_grid_sensor * p_sensor;
      const PointPlace place(data.segments.empty() ? 0 : data.segments[i], grid.VoxelOf(p_m));
      const auto [segment, x, y, z] = place.words;
      const std::uint32_t number = PlaceNumber(segment, x, y, z);
      const Color color = data.color.empty() ? Color{kNoColor, kNoColor, kNoColor} : data.color[i];
      PointRun& run = known.At(number, place);
      run.weighted_m += weight * Eigen::Array4f(1.0f, p_m.x(), p_m.y(), p_m.z());
      run.weighted_color += Eigen::Array4f(weight * color.r, weight * color.g, weight * color.b, 1.0f);
    }
    tally.NoteRuns(runs);
    bands[band] = std::move(runs);
  });
}

}  // namespace dhpmap
