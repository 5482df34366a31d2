// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "mapping/sensor/projected_point.h"

namespace dhpmap {

/// A part of an image around a pixel.
struct PixelWindow {
  float half_width_px, half_height_px;
  [[nodiscard]] bool Has(float du_px, float dv_px) const {
    return std::abs(du_px) <= half_width_px && std::abs(dv_px) <= half_height_px;
  }
};

/// The nearest point of each cell of an image, with queries of a window around any pixel. The order of points does not
/// matter. Immutable, thread-safe.
class SparseDepth {
 public:
  /// Points lie in the image, which starts at pixel (0, 0) as the cells do.
  SparseDepth(std::span<const ProjectedPoint> points, int width_px, int height_px, float cell_width_px,
              float cell_height_px, PixelWindow window);

  /// False: nothing in the window's part above p, at its height included, is nearer than the limit. True: maybe.
  [[nodiscard]] bool MayHaveAbove(const ProjectedPoint& p, float limit_m) const {
    return nearest_above_m_[At(static_cast<int>(p.u_px * per_u_), static_cast<int>(p.v_px * per_v_))] < limit_m;
  }

  /// Calls use(nearest point) for each cell that the window around p touches, until it returns true; returns whether it
  /// did. Empty cells are infinitely far.
  template <typename Use>
  bool AnyAround(const ProjectedPoint& p, const Use& use) const {
    const int u0 = std::max(static_cast<int>((p.u_px - window_.half_width_px) * per_u_), 0);
    const int v0 = std::max(static_cast<int>((p.v_px - window_.half_height_px) * per_v_), 0);
    const int u1 = std::min(static_cast<int>((p.u_px + window_.half_width_px) * per_u_), num_columns_ - 1);
    const int v1 = std::min(static_cast<int>((p.v_px + window_.half_height_px) * per_v_), num_rows_ - 1);
    for (int v = v0; v <= v1; ++v) {
      for (int u = u0; u <= u1; ++u) {
        if (use(cells_[At(u, v)])) return true;
      }
    }
    return false;
  }

 private:
  [[nodiscard]] std::size_t At(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(num_columns_) + static_cast<std::size_t>(u);
  }
  PixelWindow window_;
  float per_u_, per_v_;
  int num_columns_, num_rows_;
  std::vector<ProjectedPoint> cells_;
  std::vector<float> nearest_above_m_;
};

}  // namespace dhpmap
