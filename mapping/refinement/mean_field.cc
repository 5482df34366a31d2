// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/mean_field.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "mapping/refinement/float8.h"

namespace dhpmap {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::size_t kBlockPoints = 16;  // worked on together, in the nearest cache
constexpr float kSurest = 1e30f;          // a unary of -infinity counts as this, to keep differences finite

/// messages (+)= the values interpolated at a point, on the N vectors that begin at `rows` and `messages`.
template <int N, int D>
DHPMAP_ALWAYS_INLINE void Slice(const typename PermutohedralLattice<D>::Corners& corners, const float* rows,
                                std::size_t stride, float* messages) {
  Float8 sum[N];
  for (int v = 0; v < N; ++v) sum[v] = Vector8(messages, v);
  for (int k = 0; k <= D; ++k) {
    const float weight = corners.weight[k];
    const float* row = rows + corners.row[k] * stride;
    for (int v = 0; v < N; ++v) sum[v] += weight * Vector8(row, v);
  }
  for (int v = 0; v < N; ++v) Vector8(messages, v) = sum[v];
}

template <int N, int D>
DHPMAP_ALWAYS_INLINE void Splat(const typename PermutohedralLattice<D>::Corners& corners, const float* q,
                                std::size_t stride, float* rows) {
  Float8 value[N];
  for (int v = 0; v < N; ++v) value[v] = Vector8(q, v);
  for (int k = 0; k <= D; ++k) {
    const float weight = corners.weight[k];
    float* row = rows + corners.row[k] * stride;
    for (int v = 0; v < N; ++v) Vector8(row, v) += weight * value[v];
  }
}

template <int D>
DHPMAP_ALWAYS_INLINE void SliceAll(const typename PermutohedralLattice<D>::Corners& corners, const float* rows,
                                   std::size_t stride, float* messages) {
  std::size_t c = 0;
  for (; c + 32 <= stride; c += 32) Slice<4, D>(corners, rows + c, stride, messages + c);
  switch ((stride - c) / 8) {
    case 1: Slice<1, D>(corners, rows + c, stride, messages + c); break;
    case 2: Slice<2, D>(corners, rows + c, stride, messages + c); break;
    case 3: Slice<3, D>(corners, rows + c, stride, messages + c); break;
    default: break;
  }
}

template <int D>
DHPMAP_ALWAYS_INLINE void SplatAll(const typename PermutohedralLattice<D>::Corners& corners, const float* q,
                                   std::size_t stride, float* rows) {
  std::size_t c = 0;
  for (; c + 32 <= stride; c += 32) Splat<4, D>(corners, q + c, stride, rows + c);
  switch ((stride - c) / 8) {
    case 1: Splat<1, D>(corners, q + c, stride, rows + c); break;
    case 2: Splat<2, D>(corners, q + c, stride, rows + c); break;
    case 3: Splat<3, D>(corners, q + c, stride, rows + c); break;
    default: break;
  }
}

/// q = (q - unaries) less its greatest element of the kind, -infinity where a label is impossible.
DHPMAP_ALWAYS_INLINE void SubtractUnaries(const LabelLayout& layout, const float* unaries, float* q) {
  const Int8 lane = {0, 1, 2, 3, 4, 5, 6, 7};
  for (const LabelLayout::Kind& kind : layout.kinds) {
    Float8 most = Float8{} - kInfinity;
    for (int v = kind.begin; v < kind.end; ++v) {
      const Float8 u = Vector8(unaries + layout.vectors[v].first_label, 0);
      const Int8 is_possible = (u < kInfinity) & (lane < layout.vectors[v].num_labels);
      Float8 x = Vector8(q, v) - (u > -kSurest ? u : Float8{} - kSurest);
      x = is_possible ? x : Float8{} - kInfinity;
      most = most > x ? most : x;
      Vector8(q, v) = x;
    }
    SpreadMax(most);
    for (int v = kind.begin; v < kind.end; ++v) Vector8(q, v) -= most;
  }
}

DHPMAP_ALWAYS_INLINE void ScaleToOne(const LabelLayout& layout, float* q) {
  for (const LabelLayout::Kind& kind : layout.kinds) {
    Float8 sum = {};
    for (int v = kind.begin; v < kind.end; ++v) sum += Vector8(q, v);
    SpreadSum(sum);
    const Float8 scale = 1.0f / sum;
    for (int v = kind.begin; v < kind.end; ++v) Vector8(q, v) *= scale;
  }
}

/// Where all labels of a kind are impossible, the unaries become 0.
void SettleUnaries(const LabelLayout& layout, float* unaries) {
  for (const LabelLayout::Kind& kind : layout.kinds) {
    float* begin = unaries + layout.vectors[kind.begin].first_label;
    float* end = unaries + layout.vectors[kind.end - 1].first_label + layout.vectors[kind.end - 1].num_labels;
    if (std::none_of(begin, end, [](float u) { return u < kInfinity; })) std::fill(begin, end, 0.0f);
  }
}

void WriteMarginals(const LabelLayout& layout, const float* q, float* marginals) {
  for (std::size_t v = 0; v < layout.vectors.size(); ++v) {
    std::copy(q + 8 * v, q + 8 * v + layout.vectors[v].num_labels, marginals + layout.vectors[v].first_label);
  }
}

/// Points [begin, end) of the chunk. Step by step for all of them: each step is a chain of dependent operations for one
/// point, but independent of the others.
DHPMAP_VECTOR_CLONES
void RunPoints(MeanFieldPass pass, const LabelLayout& layout, std::span<const std::uint32_t> order, std::size_t begin,
               std::size_t end, const LatticeChunk<3>& smoothness, const LatticeChunk<6>& appearance,
               std::span<float> values, float* smoothness_sums, float* appearance_sums, float* q, float* last_row) {
  const std::size_t stride = layout.num_channels(), num_labels = layout.num_labels, num_points = end - begin;
  const bool is_first = pass == MeanFieldPass::kFirst || pass == MeanFieldPass::kOnly;
  const bool is_last = pass == MeanFieldPass::kLast || pass == MeanFieldPass::kOnly;
  for (std::size_t i = begin; i < end; ++i) __builtin_prefetch(values.data() + order[i] * num_labels);
  std::fill(q, q + num_points * stride, 0.0f);
  for (std::size_t i = begin; i < end && !is_first; ++i) {
    float* messages = q + (i - begin) * stride;
    if (smoothness.corners) SliceAll<3>(smoothness.corners[i], smoothness.rows, stride, messages);
    if (appearance.corners) SliceAll<6>(appearance.corners[i], appearance.rows, stride, messages);
  }
  for (std::size_t i = begin; i < end; ++i) {
    float* unaries = values.data() + order[i] * num_labels;
    if (is_first) SettleUnaries(layout, unaries);
    if (order[i] * num_labels + num_labels + 8 > values.size()) {  // vectors must not reach beyond the caller's array
      std::copy(unaries, unaries + num_labels, last_row);
      unaries = last_row;
    }
    SubtractUnaries(layout, unaries, q + (i - begin) * stride);
  }
  for (int v = 0; v < static_cast<int>(num_points * layout.vectors.size()); ++v) {
    Float8 x = Vector8(q, v);
    ExpOfNegative(x);
    Vector8(q, v) = x;
  }
  for (std::size_t i = 0; i < num_points; ++i) ScaleToOne(layout, q + i * stride);
  for (std::size_t i = begin; i < end; ++i) {
    const float* marginals = q + (i - begin) * stride;
    if (is_last) {
      WriteMarginals(layout, marginals, values.data() + order[i] * num_labels);
    } else {
      if (smoothness.corners) SplatAll<3>(smoothness.corners[i], marginals, stride, smoothness_sums);
      if (appearance.corners) SplatAll<6>(appearance.corners[i], marginals, stride, appearance_sums);
    }
  }
}

}  // namespace

LabelLayout::LabelLayout(std::span<const int> labels_of_kinds) {
  for (const int num_labels_of_kind : labels_of_kinds) {
    const auto begin = static_cast<int>(vectors.size());
    for (int l = 0; l < num_labels_of_kind; l += 8) {
      vectors.push_back({num_labels, std::min(8, num_labels_of_kind - l)});
      num_labels += static_cast<std::size_t>(vectors.back().num_labels);
    }
    if (num_labels_of_kind > 0) kinds.push_back({begin, static_cast<int>(vectors.size())});
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
  scratch.last_row.assign(layout.num_labels + 8, 0.0f);
  for (std::size_t i = 0; i < order.size(); i += kBlockPoints) {
    RunPoints(pass, layout, order, i, std::min(order.size(), i + kBlockPoints), smoothness, appearance, values,
              scratch.smoothness_rows.data(), scratch.appearance_rows.data(), scratch.q.data(),
              scratch.last_row.data());
  }
  if (splats) {
    std::copy(scratch.smoothness_rows.begin(), scratch.smoothness_rows.end(), smoothness.rows);
    std::copy(scratch.appearance_rows.begin(), scratch.appearance_rows.end(), appearance.rows);
  }
}

}  // namespace dhpmap
