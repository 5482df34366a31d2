// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/sparse_depth.h"

#include <limits>
#include <tuple>

namespace dhpmap {
namespace {

/// Each value becomes the least of itself and of `num_before` earlier and `num_after` later ones, `step` apart.
void SpreadLeast(std::size_t num_before, std::size_t num_after, std::size_t step, std::vector<float>& values) {
  const std::vector<float> in = values;
  const auto take = [&](std::size_t to, std::size_t from, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) values[to + i] = std::min(values[to + i], in[from + i]);
  };
  for (std::size_t k = 1; k <= num_before && k * step < in.size(); ++k) take(k * step, 0, in.size() - k * step);
  for (std::size_t k = 1; k <= num_after && k * step < in.size(); ++k) take(0, k * step, in.size() - k * step);
}

}  // namespace

SparseDepth::SparseDepth(std::span<const ProjectedPoint> points, int width_px, int height_px, float cell_width_px,
                         float cell_height_px, PixelWindow window)
    : window_(window),
      per_u_(1 / cell_width_px),
      per_v_(1 / cell_height_px),
      num_columns_(static_cast<int>(static_cast<float>(width_px) * per_u_) + 1),
      num_rows_(static_cast<int>(static_cast<float>(height_px) * per_v_) + 1),
      cells_(static_cast<std::size_t>(num_columns_) * static_cast<std::size_t>(num_rows_),
             ProjectedPoint{0, 0, std::numeric_limits<float>::infinity()}) {
  const auto key = [](const ProjectedPoint& p) { return std::tie(p.depth_m, p.u_px, p.v_px); };
  for (const ProjectedPoint& p : points) {
    ProjectedPoint& nearest = cells_[At(static_cast<int>(p.u_px * per_u_), static_cast<int>(p.v_px * per_v_))];
    if (key(p) < key(nearest)) nearest = p;
  }
  nearest_above_m_.reserve(cells_.size());
  for (const ProjectedPoint& cell : cells_) nearest_above_m_.push_back(cell.depth_m);
  const auto num_beside = static_cast<std::size_t>(std::ceil(window.half_width_px * per_u_)) + 1;
  const auto num_above = static_cast<std::size_t>(std::ceil(window.half_height_px * per_v_)) + 1;
  SpreadLeast(num_above, 0, static_cast<std::size_t>(num_columns_), nearest_above_m_);
  SpreadLeast(num_beside, num_beside, 1, nearest_above_m_);  // over the ends of rows, too: it says maybe
}

}  // namespace dhpmap
