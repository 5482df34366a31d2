// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/mean_field.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "mapping/refinement/float8.h"

namespace dhpmap {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kSurest = 1e30f;  // a unary of -infinity counts as this, to keep differences finite

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

/// Subtracts the unaries and takes the softmax of each kind in place.
DHPMAP_ALWAYS_INLINE void Softmax(const LabelLayout& layout, const float* unaries, float* q) {
  const Int8 lane = {0, 1, 2, 3, 4, 5, 6, 7};
  std::size_t begin = 0;
  for (std::size_t end = 1; end <= layout.vectors.size(); ++end) {
    if (!layout.vectors[end - 1].ends_kind) continue;
    Float8 most = Float8{} - kInfinity;
    for (std::size_t v = begin; v < end; ++v) {
      const Float8 u = Vector8(unaries + layout.vectors[v].first_label, 0);
      const Int8 is_possible = (u < kInfinity) & (lane < layout.vectors[v].num_labels);
      Float8 x = Vector8(q, static_cast<int>(v)) - (u > -kSurest ? u : Float8{} - kSurest);
      x = is_possible ? x : Float8{} - kInfinity;
      most = most > x ? most : x;
      Vector8(q, static_cast<int>(v)) = x;
    }
    SpreadMax(most);
    Float8 sum = {};
    for (std::size_t v = begin; v < end; ++v) {
      Float8 x = Vector8(q, static_cast<int>(v)) - most;
      ExpOfNegative(x);
      sum += x;
      Vector8(q, static_cast<int>(v)) = x;
    }
    SpreadSum(sum);
    const Float8 scale = 1.0f / sum;
    for (std::size_t v = begin; v < end; ++v) Vector8(q, static_cast<int>(v)) *= scale;
    begin = end;
  }
}

/// Where all labels of a kind are impossible, the unaries become 0.
void SettleUnaries(const LabelLayout& layout, float* unaries) {
  bool any = false;
  std::size_t begin = 0;
  for (const LabelLayout::Vector& vector : layout.vectors) {
    const std::size_t end = vector.first_label + static_cast<std::size_t>(vector.num_labels);
    for (std::size_t l = vector.first_label; l < end; ++l) any |= unaries[l] < kInfinity;
    if (!vector.ends_kind) continue;
    if (!any) std::fill(unaries + begin, unaries + end, 0.0f);
    any = false;
    begin = end;
  }
}

void WriteMarginals(const LabelLayout& layout, const float* q, float* marginals) {
  for (std::size_t v = 0; v < layout.vectors.size(); ++v) {
    std::copy(q + 8 * v, q + 8 * v + layout.vectors[v].num_labels, marginals + layout.vectors[v].first_label);
  }
}

DHPMAP_VECTOR_CLONES
void RunPoints(MeanFieldPass pass, const LabelLayout& layout, std::span<const std::uint32_t> order,
               const LatticeChunk<3>& smoothness, const LatticeChunk<6>& appearance, std::span<float> values,
               float* smoothness_sums, float* appearance_sums, float* q, float* last_row) {
  const std::size_t stride = layout.num_channels(), num_labels = layout.num_labels;
  const bool is_first = pass == MeanFieldPass::kFirst || pass == MeanFieldPass::kOnly;
  const bool is_last = pass == MeanFieldPass::kLast || pass == MeanFieldPass::kOnly;
  for (std::size_t i = 0; i < order.size(); ++i) {
    float* row = values.data() + order[i] * num_labels;
    if (is_first) SettleUnaries(layout, row);
    const float* unaries = row;
    if (order[i] * num_labels + num_labels + 8 > values.size()) {  // vectors must not reach beyond the caller's array
      std::copy(row, row + num_labels, last_row);
      unaries = last_row;
    }
    std::fill(q, q + stride, 0.0f);
    if (!is_first && smoothness.corners) SliceAll<3>(smoothness.corners[i], smoothness.rows, stride, q);
    if (!is_first && appearance.corners) SliceAll<6>(appearance.corners[i], appearance.rows, stride, q);
    Softmax(layout, unaries, q);
    if (is_last) {
      WriteMarginals(layout, q, row);
    } else {
      if (smoothness.corners) SplatAll<3>(smoothness.corners[i], q, stride, smoothness_sums);
      if (appearance.corners) SplatAll<6>(appearance.corners[i], q, stride, appearance_sums);
    }
  }
}

}  // namespace

LabelLayout::LabelLayout(std::span<const int> labels_of_kinds) {
  for (const int num_labels_of_kind : labels_of_kinds) {
    for (int l = 0; l < num_labels_of_kind; l += 8) {
      const int n = std::min(8, num_labels_of_kind - l);
      vectors.push_back({num_labels, n, l + 8 >= num_labels_of_kind});
      num_labels += static_cast<std::size_t>(n);
    }
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
  scratch.q.resize(stride);
  scratch.last_row.assign(layout.num_labels + 8, 0.0f);
  RunPoints(pass, layout, order, smoothness, appearance, values, scratch.smoothness_rows.data(),
            scratch.appearance_rows.data(), scratch.q.data(), scratch.last_row.data());
  if (splats) {
    std::copy(scratch.smoothness_rows.begin(), scratch.smoothness_rows.end(), smoothness.rows);
    std::copy(scratch.appearance_rows.begin(), scratch.appearance_rows.end(), appearance.rows);
  }
}

}  // namespace dhpmap
