// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/crf/permutohedral_lattice.h"

#include <algorithm>
#include <cmath>

#include "mapping/crf/lattice_builder.h"

namespace dhpmap {

template <int D>
void PermutohedralLattice<D>::Build(std::span<const Feature> features, ThreadPool& pool) {
  corners_.Resize(features.size());
  slice_factor_ = 1.0f / (1.0f + 1.0f / (1 << D));
  LatticeBuilder<D> builder(pool);
  builder.FindCorners(features, kChunkPoints, corners_.data(), graph_);
  builder.JoinChunks(graph_);
  builder.FindNeighbours(graph_);
}

template <int D>
void PermutohedralLattice<D>::Normalize(float weight, ThreadPool& pool) {
  GrowBuffer<float> sums;
  sums.Resize(num_points());
  std::fill(sums.begin(), sums.end(), 1.0f);
  Filter({sums.data(), sums.size()}, 1, {sums.data(), sums.size()}, pool);
  const float factor = weight * slice_factor_;
  pool.ParallelFor(num_chunks(), [&](std::size_t chunk) {
    const std::size_t end = std::min(num_points(), (chunk + 1) * kChunkPoints);
    for (std::size_t i = chunk * kChunkPoints; i < end; ++i) {
      // Positive, because the self term alone is at least 1/(D+1). Weights are used once to splat and once to slice.
      corners_[i].scale *= std::sqrt(factor / sums[i]);
    }
  });
  slice_factor_ = 1.0f;
}

template <int D>
void PermutohedralLattice<D>::Filter(std::span<const float> in, std::size_t channels, std::span<float> out,
                                     ThreadPool& pool) const {
  const std::size_t stride = channels == 1 ? 1 : (channels + 7) / 8 * 8;
  GrowBuffer<float> values;
  values.Resize(graph_.num_rows() * stride);
  pool.ParallelFor(num_chunks(), [&](std::size_t chunk) {
    float* chunk_values = values.data() + graph_.chunk_row[chunk] * stride;
    std::fill(chunk_values, values.data() + graph_.chunk_row[chunk + 1] * stride, 0.0f);
    const std::size_t end = std::min(num_points(), (chunk + 1) * kChunkPoints);
    for (std::size_t i = chunk * kChunkPoints; i < end; ++i) {
      for (std::size_t k = 0; k <= D; ++k) {
        float* row = chunk_values + corners_[i].row[k] * stride;
        const float weight = corners_[i].scale * static_cast<float>(corners_[i].weight[k]);
        for (std::size_t c = 0; c < channels; ++c) row[c] += weight * in[i * channels + c];
      }
    }
  });
  graph_.Blur(values.data(), stride, pool);
  pool.ParallelFor(num_chunks(), [&](std::size_t chunk) {
    const float* chunk_values = values.data() + graph_.chunk_row[chunk] * stride;
    const std::size_t end = std::min(num_points(), (chunk + 1) * kChunkPoints);
    for (std::size_t i = chunk * kChunkPoints; i < end; ++i) {
      for (std::size_t c = 0; c < channels; ++c) {
        float sum = 0;
        for (std::size_t k = 0; k <= D; ++k) {
          sum += static_cast<float>(corners_[i].weight[k]) * chunk_values[corners_[i].row[k] * stride + c];
        }
        out[i * channels + c] = slice_factor_ * corners_[i].scale * sum;
      }
    }
  });
}

template class PermutohedralLattice<3>;
template class PermutohedralLattice<6>;

}  // namespace dhpmap
