// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/sight_pyramid.h"

#include <algorithm>

#include "mapping/base/vector_clones.h"

namespace dhpmap {
namespace {

/// Reduces two rows of 2 n values to n minima and maxima of four values each.
DHPMAP_WIDE_VECTOR_CLONES
void HalveRow(const float* __restrict least0, const float* __restrict least1, const float* __restrict most0,
              const float* __restrict most1, int n, float* __restrict least, float* __restrict most) {
  for (int i = 0; i < n; ++i) {
    const float a = least0[2 * i], b = least0[2 * i + 1], c = least1[2 * i], d = least1[2 * i + 1];
    const float ab = a < b ? a : b, cd = c < d ? c : d;
    least[i] = ab < cd ? ab : cd;
    const float e = most0[2 * i], f = most0[2 * i + 1], g = most1[2 * i], h = most1[2 * i + 1];
    const float ef = e > f ? e : f, gh = g > h ? g : h;
    most[i] = ef > gh ? ef : gh;
  }
}

/// Minimum and maximum of each 2 x 2 values, of rows of n + 1 values.
DHPMAP_WIDE_VECTOR_CLONES
void SlideRow(const float* __restrict least0, const float* __restrict least1, const float* __restrict most0,
              const float* __restrict most1, int n, SightPyramid::Span* __restrict slid) {
  for (int i = 0; i < n; ++i) {
    const float ab = least0[i] < least0[i + 1] ? least0[i] : least0[i + 1];
    const float cd = least1[i] < least1[i + 1] ? least1[i] : least1[i + 1];
    slid[i].least = ab < cd ? ab : cd;
    const float ef = most0[i] > most0[i + 1] ? most0[i] : most0[i + 1];
    const float gh = most1[i] > most1[i + 1] ? most1[i] : most1[i + 1];
    slid[i].most = ef > gh ? ef : gh;
  }
}

/// A grid of values that continues beyond its last row; each row has `width` values.
struct Plane {
  const float* data;
  int width, height;
  [[nodiscard]] const float* Row(int v) const {
    return data + static_cast<std::size_t>(std::min(v, height - 1)) * static_cast<std::size_t>(width);
  }
};

}  // namespace

void SightPyramid::Build(const SightImage& image) {
  num_levels_ = 0;
  most_ = 0;
  if (image.width <= 0 || image.height <= 0) return;
  Plane least{image.limit_vox.data(), image.width, image.height};
  Plane most = least;
  // Ends when every rectangle has at most four cells a side.
  for (;;) {
    if (levels_.size() <= num_levels_) levels_.emplace_back();
    Level& level = levels_[num_levels_++];
    level.width = (least.width + 1) / 2;
    level.height = (least.height + 1) / 2;
    const std::size_t size = static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height);
    level.least.resize(size), level.most.resize(size), level.slid.resize(size);
    const auto row = [&level](std::vector<float>& plane, int v) {
      return plane.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(level.width);
    };
    for (int v = 0; v < level.height; ++v) {
      HalveRow(least.Row(2 * v), least.Row(2 * v + 1), most.Row(2 * v), most.Row(2 * v + 1), least.width / 2,
               row(level.least, v), row(level.most, v));
      if (least.width % 2 != 0) {  // the last column has no neighbour
        const auto last = static_cast<std::size_t>(least.width - 1);
        row(level.least, v)[last / 2] = std::min(least.Row(2 * v)[last], least.Row(2 * v + 1)[last]);
        row(level.most, v)[last / 2] = std::max(most.Row(2 * v)[last], most.Row(2 * v + 1)[last]);
      }
    }
    least = {level.least.data(), level.width, level.height};
    most = {level.most.data(), level.width, level.height};
    for (int v = 0; v < level.height; ++v) {
      Span* slid = level.slid.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(level.width);
      SlideRow(least.Row(v), least.Row(v + 1), most.Row(v), most.Row(v + 1), level.width - 1, slid);
      const auto last = static_cast<std::size_t>(level.width - 1);
      slid[last] = {std::min(least.Row(v)[last], least.Row(v + 1)[last]),
                    std::max(most.Row(v)[last], most.Row(v + 1)[last])};
    }
    if (level.width <= 4 && level.height <= 4) break;
  }
  const Level& top = levels_[num_levels_ - 1];
  most_ = *std::max_element(top.most.begin(), top.most.end());
}

}  // namespace dhpmap
