// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/crf/mean_field.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "mapping/crf/float8.h"

namespace dhpmap {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kBlockPoints = 16;  // processed together, in the first-level cache
constexpr float kSurest = 1e30f;          // replaces a unary of -infinity, to keep differences finite

/// Consecutive points of a chunk, and N vectors of each row that belongs to them; other vectors are c floats away.
struct Points {
  std::size_t begin, end;  ///< of the chunk
  const LatticeChunk<3>& smoothness;
  const LatticeChunk<6>& appearance;
  float *smoothness_rows, *appearance_rows;  ///< source of slicing or target of splatting
  float* q;                                  ///< one row for each point
  std::size_t stride;
};

/// Adds the values interpolated at a point to `sum`.
template <int N, typename Corners>
DHPMAP_ALWAYS_INLINE void Slice(const Corners& corners, const float* rows, std::size_t stride, Float8* sum) {
  for (std::size_t k = 0; k < corners.row.size(); ++k) {
    const float* row = rows + corners.row[k] * stride;
    const float weight = corners.scale * static_cast<float>(corners.weight[k]);
    for (int v = 0; v < N; ++v) sum[v] += weight * Vector8(row, v).x;
  }
}

template <int N, typename Corners>
DHPMAP_ALWAYS_INLINE void Splat(const Corners& corners, const Float8* value, std::size_t stride, float* rows) {
  for (std::size_t k = 0; k < corners.row.size(); ++k) {
    float* row = rows + corners.row[k] * stride;
    const float weight = corners.scale * static_cast<float>(corners.weight[k]);
    for (int v = 0; v < N; ++v) Vector8(row, v).x += weight * value[v];
  }
}

template <int N>
DHPMAP_ALWAYS_INLINE void SlicePoints(const Points& points, std::size_t c) {
  for (std::size_t i = points.begin; i < points.end; ++i) {
    Float8 sum[N] = {};
    if (points.smoothness.corners) {
      Slice<N>(points.smoothness.corners[i], points.smoothness_rows + c, points.stride, sum);
    }
    if (points.appearance.corners) {
      Slice<N>(points.appearance.corners[i], points.appearance_rows + c, points.stride, sum);
    }
    float* q = points.q + (i - points.begin) * points.stride + c;
    for (int v = 0; v < N; ++v) Vector8(q, v).x = sum[v];
  }
}

template <int N>
DHPMAP_ALWAYS_INLINE void SplatPoints(const Points& points, std::size_t c) {
  for (std::size_t i = points.begin; i < points.end; ++i) {
    const float* q = points.q + (i - points.begin) * points.stride + c;
    Float8 value[N];
    for (int v = 0; v < N; ++v) value[v] = Vector8(q, v).x;
    if (points.smoothness.corners) {
      Splat<N>(points.smoothness.corners[i], value, points.stride, points.smoothness_rows + c);
    }
    if (points.appearance.corners) {
      Splat<N>(points.appearance.corners[i], value, points.stride, points.appearance_rows + c);
    }
  }
}

// Up to 4 vectors fit into registers.
DHPMAP_ALWAYS_INLINE void SliceAll(const Points& points) {
  std::size_t c = 0;
  for (; c + 32 <= points.stride; c += 32) SlicePoints<4>(points, c);
  switch ((points.stride - c) / 8) {
    case 1: SlicePoints<1>(points, c); break;
    case 2: SlicePoints<2>(points, c); break;
    case 3: SlicePoints<3>(points, c); break;
    default: break;
  }
}

DHPMAP_ALWAYS_INLINE void SplatAll(const Points& points) {
  std::size_t c = 0;
  for (; c + 32 <= points.stride; c += 32) SplatPoints<4>(points, c);
  switch ((points.stride - c) / 8) {
    case 1: SplatPoints<1>(points, c); break;
    case 2: SplatPoints<2>(points, c); break;
    case 3: SplatPoints<3>(points, c); break;
    default: break;
  }
}

DHPMAP_ALWAYS_INLINE const RowMask8& MaskOf(const LabelLayout::Part& part) {
  return *reinterpret_cast<const RowMask8*>(part.mask.data());
}

/// Subtracts the v-th vector of unaries; the result is -infinity for impossible labels.
DHPMAP_ALWAYS_INLINE void SubtractVector(const float* unaries, int v, float* q) {
  const Float8 u = Vector8(unaries, 0).x;
  const Float8 x = Vector8(q, v).x - (u > -kSurest ? u : Float8{} - kSurest);
  Vector8(q, v).x = u < kInfinity ? x : Float8{} - kInfinity;
}

/// The exponent of paper eq. (1), -E by label: the pairwise terms of eq. (4), given in q, minus the unary term of eq.
/// (3). q = (q - unaries) minus its maximum within each kind of labels. `tail`: the last unaries, which do not fill a
/// vector, padded with infinity.
DHPMAP_ALWAYS_INLINE void SubtractUnaries(const LabelLayout& layout, const float* unaries, const float* tail,
                                          float* q) {
  const auto num_whole = static_cast<int>(layout.num_labels / 8);
  for (int v = 0; v < num_whole; ++v) SubtractVector(unaries + 8 * v, v, q);
  if (layout.num_labels % 8 != 0) SubtractVector(tail, num_whole, q);
  for (const LabelLayout::Kind& kind : layout.kinds) {
    Float8 most = Float8{} - kInfinity;
    for (const LabelLayout::Part& part : kind.parts) {
      const Float8 x = MaskOf(part).x ? Vector8(q, part.vector).x : Float8{} - kInfinity;
      most = most > x ? most : x;
    }
    SpreadMax(most);
    for (const LabelLayout::Part& part : kind.parts) {
      const Float8 x = Vector8(q, part.vector).x;
      Vector8(q, part.vector).x = MaskOf(part).x ? x - most : x;
    }
  }
}

/// Z of paper eq. (1), for each kind of labels and each point.
DHPMAP_ALWAYS_INLINE void ScaleToOne(const LabelLayout& layout, float* q) {
  for (const LabelLayout::Kind& kind : layout.kinds) {
    Float8 sum = {};
    for (const LabelLayout::Part& part : kind.parts) sum += MaskOf(part).x ? Vector8(q, part.vector).x : Float8{};
    SpreadSum(sum);
    const Float8 scale = 1.0f / sum;
    for (const LabelLayout::Part& part : kind.parts) {
      Vector8(q, part.vector).x *= MaskOf(part).x ? scale : Float8{} + 1.0f;
    }
  }
}

/// Copies fewer than 8 floats. Does not write a whole vector, because another thread may own the memory after them.
DHPMAP_ALWAYS_INLINE void CopyTail(const float* from, std::size_t n, float* to) {
  if (n & 4) {
    std::memcpy(to, from, 4 * sizeof(float));
    to += 4;
    from += 4;
  }
  if (n & 2) {
    std::memcpy(to, from, 2 * sizeof(float));
    to += 2;
    from += 2;
  }
  if (n & 1) *to = *from;
}

/// Sets the unaries of a kind to 0 if all its labels are impossible.
void SettleUnaries(const LabelLayout& layout, float* unaries) {
  for (const LabelLayout::Kind& kind : layout.kinds) {
    float *begin = unaries + kind.begin, *end = unaries + kind.end;
    if (std::none_of(begin, end, [](float u) { return u < kInfinity; })) std::fill(begin, end, 0.0f);
  }
}

/// One pass over some points, each step for all of them: for one point the steps are a chain of dependent operations,
/// but points are independent. `points` slices from the chunk, `sums` splats to working memory.
DHPMAP_VECTOR_CLONES
void RunPoints(MeanFieldPass pass, const LabelLayout& layout, std::span<const std::uint32_t> order,
               const Points& points, const Points& sums, std::span<float> values, float* tails) {
  const std::size_t stride = layout.num_channels(), num_labels = layout.num_labels;
  const bool is_first = pass == MeanFieldPass::kFirst || pass == MeanFieldPass::kOnly;
  const bool is_last = pass == MeanFieldPass::kLast || pass == MeanFieldPass::kOnly;
  for (std::size_t i = 0; i < order.size(); ++i) {
    float* unaries = values.data() + order[i] * num_labels;
    if (is_first) SettleUnaries(layout, unaries);
    CopyTail(unaries + num_labels / 8 * 8, num_labels % 8, tails + 8 * i);
  }
  if (is_first) {
    std::fill(points.q, points.q + order.size() * stride, 0.0f);
  } else {
    SliceAll(points);
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    SubtractUnaries(layout, values.data() + order[i] * num_labels, tails + 8 * i, points.q + i * stride);
  }
  for (int v = 0; v < static_cast<int>(order.size() * stride / 8); ++v) {
    Float8 x = Vector8(points.q, v).x;
    ExpOfNegative(x);
    Vector8(points.q, v).x = x;
  }
  for (std::size_t i = 0; i < order.size(); ++i) ScaleToOne(layout, points.q + i * stride);
  if (is_last) {
    for (std::size_t i = 0; i < order.size(); ++i) {
      std::copy_n(points.q + i * stride, num_labels, values.data() + order[i] * num_labels);
    }
  } else {
    SplatAll(sums);
  }
}

}  // namespace

LabelLayout::LabelLayout(std::span<const int> labels_of_kinds) {
  for (const int num_labels_of_kind : labels_of_kinds) {
    if (num_labels_of_kind <= 0) continue;
    Kind kind{num_labels, num_labels + static_cast<std::size_t>(num_labels_of_kind), {}};
    num_labels = kind.end;
    for (std::size_t v = kind.begin / 8; 8 * v < kind.end; ++v) {
      Part part{static_cast<int>(v), {}};
      for (std::size_t lane = 0; lane < 8; ++lane) {
        part.mask[lane] = 8 * v + lane >= kind.begin && 8 * v + lane < kind.end ? -1 : 0;
      }
      kind.parts.push_back(part);
    }
    kinds.push_back(std::move(kind));
  }
}

void RunMeanFieldPass(MeanFieldPass pass, const LabelLayout& layout, std::span<const std::uint32_t> order,
                      const LatticeChunk<3>& smoothness, const LatticeChunk<6>& appearance, std::span<float> values,
                      MeanFieldScratch& scratch) {
  const std::size_t stride = layout.num_channels();
  const std::size_t smoothness_size = smoothness.num_rows * stride, appearance_size = appearance.num_rows * stride;
  const bool splats = pass == MeanFieldPass::kFirst || pass == MeanFieldPass::kMiddle;
  if (splats) {
    scratch.smoothness_rows.assign(smoothness_size, 0.0f);
    scratch.appearance_rows.assign(appearance_size, 0.0f);
  }
  scratch.q.resize(kBlockPoints * stride);
  scratch.tails.assign(kBlockPoints * 8, kInfinity);
  for (std::size_t begin = 0; begin < order.size(); begin += kBlockPoints) {
    const std::size_t end = std::min(order.size(), begin + kBlockPoints);
    for (std::size_t i = end; i < std::min(order.size(), end + kBlockPoints); ++i) {
      const float* next = values.data() + order[i] * layout.num_labels;
      for (std::size_t l = 0; l < layout.num_labels; l += 16) __builtin_prefetch(next + l);
    }
    Points points{begin, end, smoothness, appearance, smoothness.rows, appearance.rows, scratch.q.data(), stride};
    Points sums = points;
    sums.smoothness_rows = scratch.smoothness_rows.data();
    sums.appearance_rows = scratch.appearance_rows.data();
    RunPoints(pass, layout, order.subspan(begin, end - begin), points, sums, values, scratch.tails.data());
  }
  if (splats) {
    std::copy(scratch.smoothness_rows.begin(), scratch.smoothness_rows.end(), smoothness.rows);
    std::copy(scratch.appearance_rows.begin(), scratch.appearance_rows.end(), appearance.rows);
  }
}

}  // namespace dhpmap
