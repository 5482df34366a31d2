// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/point_runs.h"

#include <algorithm>
#include <cstddef>

#include "mapping/fusion/point_kernel.h"

namespace dhpmap {
namespace {

// Sizes of the parts that are worked on in parallel: fixed, so that the result does not depend on the thread count.
constexpr int kRowsPerBand = 16;
constexpr std::size_t kPointsPerBand = 4096;

Color ColorAt(const std::vector<Color>& colors, std::size_t i) {
  return colors.empty() ? Color{128, 128, 128} : colors[i];
}

/// What a band's rows are worked on with, one after the other.
struct RowRoom {
  std::vector<float> values;
  std::vector<std::int32_t> voxels;
  std::vector<std::uint8_t> goes_on;
  RowPoints points;

  explicit RowRoom(std::size_t width)
      : values(4 * width), voxels(3 * width), goes_on(width + 1), points{values.data(),
                                                                         values.data() + width,
                                                                         values.data() + 2 * width,
                                                                         values.data() + 3 * width,
                                                                         voxels.data(),
                                                                         voxels.data() + width,
                                                                         voxels.data() + 2 * width} {}
};

/// Sums up a row of pixels, run by run. The sums stay in registers until a run ends.
void CombineRow(const RowRoom& room, const std::uint32_t* segments, const Color* colors, std::size_t width,
                std::vector<PointRun>& runs) {
  constexpr float kGrey = 128.0f;
  const RowPoints& points = room.points;
  const std::uint8_t* const goes_on = room.goes_on.data();
  std::size_t u = 0;
  while (u < width) {
    if (points.weight[u] == 0.0f) {
      ++u;
      continue;
    }
    float weight = 0, sum_x = 0, sum_y = 0, sum_z = 0, red = 0, green = 0, blue = 0;
    const std::size_t begin = u;
    do {
      const float w = points.weight[u];
      weight += w;
      sum_x += points.weighted_x_m[u];
      sum_y += points.weighted_y_m[u];
      sum_z += points.weighted_z_m[u];
      if (colors) {
        red += w * static_cast<float>(colors[u].r);
        green += w * static_cast<float>(colors[u].g);
        blue += w * static_cast<float>(colors[u].b);
      }
    } while (goes_on[++u] != 0);
    if (colors == nullptr) red = green = blue = kGrey * weight;
    runs.push_back({segments ? segments[begin] : 0,
                    {points.voxel_x[begin], points.voxel_y[begin], points.voxel_z[begin]},
                    static_cast<std::uint32_t>(u - begin),
                    weight,
                    {sum_x, sum_y, sum_z},
                    {red, green, blue}});
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

  bands.resize(static_cast<std::size_t>((camera.height_px + kRowsPerBand - 1) / kRowsPerBand));
  pool.ParallelFor(bands.size(), [&](std::size_t band) {
    std::vector<PointRun>& runs = bands[band];
    runs.clear();
    if (tally.is_too_large()) return;
    RowRoom room(width);
    const int end_row = std::min(camera.height_px, static_cast<int>(band + 1) * kRowsPerBand);
    for (int v = static_cast<int>(band) * kRowsPerBand; v < end_row; ++v) {
      const auto y = static_cast<float>((v - camera.cy_px) / camera.fy_px);
      RowGeometry geometry = shared;
      geometry.row_x = grid.R_grid_sensor(0, 1) * y + grid.R_grid_sensor(0, 2);
      geometry.row_y = grid.R_grid_sensor(1, 1) * y + grid.R_grid_sensor(1, 2);
      geometry.row_z = grid.R_grid_sensor(2, 1) * y + grid.R_grid_sensor(2, 2);
      geometry.row_length2 = y * y;
      const std::size_t first = static_cast<std::size_t>(v) * width;
      ProjectRow(data.depth_m.data() + first, camera.width_px, geometry, room.points);

      const std::uint32_t* segments = data.segments.empty() ? nullptr : data.segments.data() + first;
      const Color* colors = data.color.empty() ? nullptr : data.color.data() + first;
      MarkRuns(room.points, segments, camera.width_px, room.goes_on.data());
      CombineRow(room, segments, colors, width, runs);
    }
    tally.NoteRuns(runs);
  });
}

void CollectLidarRuns(const LidarData& data, const SensorOnGrid& grid, const IntegrationConfig& config,
                      ThreadPool& pool, FrameTally& tally, RunBands& bands) {
  const std::size_t num_points = data.points_m.size();
  bands.resize((num_points + kPointsPerBand - 1) / kPointsPerBand);
  pool.ParallelFor(bands.size(), [&](std::size_t band) {
    std::vector<PointRun>& runs = bands[band];
    runs.clear();
    if (tally.is_too_large()) return;
    const std::size_t end = std::min(num_points, (band + 1) * kPointsPerBand);
    for (std::size_t i = band * kPointsPerBand; i < end; ++i) {
      const Eigen::Vector3f& p_sensor = data.points_m[i];
      const double range = p_sensor.cast<double>().norm();
      if (!(range >= kLeastDepth_m && range >= config.min_range_m && range <= config.max_range_m)) continue;
      float weight = 1.0f;
      if (config.weighting == Weighting::kInverseRangeSquared) weight = static_cast<float>(1.0 / (range * range));
      if (config.weighting == Weighting::kInverseDepthSquared) weight = static_cast<float>(1.0 / (range * range));
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

}  // namespace dhpmap
