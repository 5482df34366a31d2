// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/slice_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "mapping/query/near_triangles.h"

namespace dhpmap {
namespace {

constexpr int kStripRows = 16, kChunkColumns = 64;

/// The part of a triangle between axis-aligned planes: a convex polygon.
struct CutTriangle {
  std::array<Eigen::Vector3d, 10> corners;  // three, plus one for each of six planes
  std::size_t count = 0;

  /// Keeps the part that is not below (sign 1) or above (sign -1) a value on an axis.
  [[nodiscard]] CutTriangle Beyond(int axis, double value, double sign) const {
    CutTriangle kept;
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d &a = corners[i], &b = corners[(i + 1) % count];
      const double of_a = sign * (a[axis] - value), of_b = sign * (b[axis] - value);
      if (of_a >= 0) kept.corners[kept.count++] = a;
      if ((of_a < 0) != (of_b < 0)) {
        Eigen::Vector3d& on_it = kept.corners[kept.count++] = a + of_a / (of_a - of_b) * (b - a);
        on_it[axis] = value;
      }
    }
    return kept;
  }
  [[nodiscard]] CutTriangle Between(int axis, double low, double high) const {
    return Beyond(axis, low, 1).Beyond(axis, high, -1);
  }
  [[nodiscard]] std::pair<double, double> RangeOn(int axis) const {
    std::pair<double, double> range(corners[0][axis], corners[0][axis]);
    for (std::size_t i = 1; i < count; ++i) {
      range.first = std::min(range.first, corners[i][axis]);
      range.second = std::max(range.second, corners[i][axis]);
    }
    return range;
  }
  [[nodiscard]] double Area() const {
    Eigen::Vector3d twice = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < count; ++i) {
      twice += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
    }
    return 0.5 * twice.norm();
  }
};

/// The cells in [first, end) that a range intersects.
std::pair<int, int> CellsOf(const std::pair<double, double>& range_cells, int first, int end) {
  const double from = std::clamp(std::floor(range_cells.first), static_cast<double>(first), static_cast<double>(end));
  const double to = std::clamp(std::floor(range_cells.second), first - 1.0, end - 1.0);
  return {static_cast<int>(from), static_cast<int>(to) + 1};
}

}  // namespace

SliceSurface::SliceSurface(const QueryWorld& world, const SliceOptions& options)
    : world_(world), options_(options), T_query_map_(options.T_map_query.inverse()) {}

const std::uint32_t* SliceSurface::Row(int y, const std::stop_token& stop) {
  if (const int strip = y / kStripRows; strip != strip_) {
    FillStrip(strip * kStripRows, stop);
    strip_ = strip;
  }
  return owners_.data() + std::ptrdiff_t{y - strip_ * kStripRows} * options_.width;
}

void SliceSurface::FillStrip(int first_row, const std::stop_token& stop) {
  strip_ = first_row / kStripRows;
  owners_.assign(static_cast<std::size_t>(kStripRows) * static_cast<std::size_t>(options_.width), kNobody);
  parts_.clear();
  for (int column = 0; column < options_.width && !stop.stop_requested(); column += kChunkColumns) {
    Visit(column, std::min(column + kChunkColumns, options_.width), stop);
  }
  if (!stop.stop_requested()) Conclude();
}

void SliceSurface::Visit(int first_column, int end_column, const std::stop_token& stop) {
  constexpr double kMargin_m = 1e-5;  // for rounding: the cut itself is exact
  const double side_m = options_.resolution_m;
  const Eigen::Vector3d low(options_.min_m.x() + first_column * side_m,
                            options_.min_m.y() + strip_ * kStripRows * side_m, options_.min_z_m);
  const Eigen::Vector3d high(options_.min_m.x() + end_column * side_m,
                             options_.min_m.y() + (strip_ + 1) * kStripRows * side_m, options_.max_z_m);
  OrientedBox box{options_.T_map_query, (high - low) / 2 + Eigen::Vector3d::Constant(kMargin_m)};
  box.T_world_box.translate((low + high) / 2);
  constexpr std::uint32_t kTrianglesALook = 256;
  std::uint32_t num_triangles = 0;
  VisitNear(world_, box, [&](const NearTriangle<OrientedBox>& near) {
    if (++num_triangles % kTrianglesALook == 0 && stop.stop_requested()) return false;
    std::array<Eigen::Vector3d, 3> triangle;
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = T_query_map_ * near.InMap(near.triangle[i].cast<double>());
    Add(triangle, static_cast<std::uint32_t>(near.number), first_column, end_column);
    return true;
  });
}

void SliceSurface::Add(const std::array<Eigen::Vector3d, 3>& triangle, std::uint32_t number, int first_column,
                       int end_column) {
  CutTriangle whole;
  for (const Eigen::Vector3d& corner : triangle) whole.corners[whole.count++] = corner;
  whole = whole.Between(2, options_.min_z_m, options_.max_z_m);
  if (whole.count == 0) return;
  const int first_row = strip_ * kStripRows;
  // From here on in units of the strip's cells.
  for (std::size_t i = 0; i < whole.count; ++i) {
    whole.corners[i].head<2>() = (whole.corners[i].head<2>() - options_.min_m) / options_.resolution_m;
  }
  const auto [row, end_row] = CellsOf(whole.RangeOn(1), first_row, std::min(first_row + kStripRows, options_.height));
  for (int y = row; y < end_row; ++y) {
    const CutTriangle in_row = whole.Between(1, y, y + 1);
    if (in_row.count == 0) continue;
    const auto [column, end] = CellsOf(in_row.RangeOn(0), first_column, end_column);
    for (int x = column; x < end; ++x) {
      const auto cell = static_cast<std::uint32_t>((y - first_row) * options_.width + x);
      owners_[cell] = number;
      if (!options_.with_objects) continue;
      CutTriangle in_cell = in_row.Between(0, x, x + 1);
      for (std::size_t i = 0; i < in_cell.count; ++i) in_cell.corners[i].head<2>() *= options_.resolution_m;
      parts_.push_back({cell, number, in_cell.Area()});
    }
  }
}

/// The object with most area; on ties the first.
void SliceSurface::Conclude() {
  std::sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) {
    return std::tie(a.cell, a.number, a.area_m2) < std::tie(b.cell, b.number, b.area_m2);
  });
  double most_m2 = -1, sum_m2 = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const bool is_new_cell = i == 0 || parts_[i].cell != parts_[i - 1].cell;
    if (is_new_cell) most_m2 = -1;
    if (is_new_cell || parts_[i].number != parts_[i - 1].number) sum_m2 = 0;
    sum_m2 += parts_[i].area_m2;
    if (sum_m2 <= most_m2) continue;
    most_m2 = sum_m2;
    owners_[parts_[i].cell] = parts_[i].number;
  }
}

}  // namespace dhpmap
