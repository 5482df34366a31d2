// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/camera_occlusion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "mapping/sensor/sparse_depth.h"

namespace dhpmap {
namespace {

constexpr float kMargin_m = 0.5f, kMarginShare = 0.1f;  // things have an extent, and poses and clocks are not exact
constexpr int kNumStrips = 256;  // of an image's width, narrow enough for beams of a row to be at one height in each
// How far from a point nearer ones may be, in strips and rows of beams: around it, and beside it farther, as dark paint
// and glass give no returns. Not as far above and below: a thing and the ground before it would enclose its foot.
constexpr float kAroundStrips = 3, kAroundRows = 2;
constexpr float kBesideStrips = 6, kBesideRows = 1;
constexpr float kMostCellRows = 1024;

/// Height in pixels from a row of beams to the next, as it usually is; 0 if there are no two rows.
int RowGap(std::span<const ProjectedPoint> points, float strip_px, int height_px) {
  const auto num_rows = static_cast<std::size_t>(height_px);
  std::vector<std::uint8_t> is_taken(kNumStrips * num_rows, 0);
  for (const ProjectedPoint& p : points) {
    const auto strip = std::min<std::size_t>(static_cast<std::size_t>(p.u_px / strip_px), kNumStrips - 1);
    is_taken[strip * num_rows + static_cast<std::size_t>(p.v_px)] = 1;
  }
  std::vector<std::size_t> num_gaps(num_rows, 0);
  std::size_t num_all = 0;
  for (std::size_t strip = 0; strip < kNumStrips; ++strip) {
    const std::uint8_t* rows = is_taken.data() + strip * num_rows;
    std::size_t last = num_rows;
    for (std::size_t row = 0; row < num_rows; ++row) {
      if (rows[row] == 0) continue;
      if (last + 1 < row) ++num_gaps[row - last], ++num_all;  // the next pixel may be the same row, slanted
      last = row;
    }
  }
  std::size_t num_passed = 0;
  for (std::size_t gap = 0; gap < num_rows; ++gap) {
    num_passed += num_gaps[gap];
    if (2 * num_passed > num_all) return static_cast<int>(gap);
  }
  return 0;
}

/// Whether the origin is in the convex hull of the points given so far: they lie in a wedge that grows until one is on
/// its other side.
class Surrounded {
 public:
  bool Add(float du, float dv) {
    const Side d{du, dv};
    if (is_empty_) {
      from_ = to_ = d;
      is_empty_ = false;
      return du == 0 && dv == 0;
    }
    const float past_from = Cross(from_, d), past_to = Cross(to_, d);
    if (past_from <= 0 && past_to >= 0 && Dot(from_, d) <= 0) return true;
    if (past_from > 0 && past_to > 0) to_ = d;
    if (past_from < 0 && past_to < 0) from_ = d;
    return false;
  }

 private:
  struct Side {
    float du = 0, dv = 0;
  };
  static float Cross(Side a, Side b) { return a.du * b.dv - a.dv * b.du; }
  static float Dot(Side a, Side b) { return a.du * b.du + a.dv * b.dv; }
  bool is_empty_ = true;
  Side from_, to_;
};

}  // namespace

std::vector<std::uint8_t> FindHiddenPoints(std::span<const ProjectedPoint> points, int width_px, int height_px) {
  std::vector<std::uint8_t> is_hidden(points.size(), 0);
  const float strip_px = std::max(static_cast<float>(width_px) / kNumStrips, 1.0f);
  const auto row_px = static_cast<float>(RowGap(points, strip_px, height_px));
  if (row_px == 0) return is_hidden;
  const float cell_height_px = std::max(row_px / 2, static_cast<float>(height_px) / kMostCellRows);
  const PixelWindow around{kAroundStrips * strip_px, kAroundRows * row_px};
  const PixelWindow beside{kBesideStrips * strip_px, kBesideRows * row_px};
  const PixelWindow either{beside.half_width_px, around.half_height_px};
  const SparseDepth depths(points, width_px, height_px, strip_px / 2, cell_height_px, either);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ProjectedPoint& p = points[i];
    const float limit_m = p.depth_m - kMargin_m - kMarginShare * p.depth_m;
    if (!depths.MayHaveAbove(p, limit_m)) continue;  // most: the ground has what is nearer below it
    Surrounded all, row;
    is_hidden[i] = depths.AnyAround(p, [&](const ProjectedPoint& q) {
      if (!(q.depth_m < limit_m)) return false;
      const float du = q.u_px - p.u_px, dv = q.v_px - p.v_px;
      return (around.Has(du, dv) && all.Add(du, dv)) || (beside.Has(du, dv) && row.Add(du, dv));
    });
  }
  return is_hidden;
}

}  // namespace dhpmap
