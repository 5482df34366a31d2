// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "mapping/base/thread_pool.h"
#include "mapping/crf/grow_buffer.h"
#include "mapping/crf/lattice_corners.h"
#include "mapping/crf/lattice_graph.h"

namespace dhpmap {

/// Sums over all pairs of points with the Gaussian weight exp(-|f_i - f_j|^2 / 2), approximately and in linear time:
/// out = K in is computed as S B S^T in, where S^T splats each point's values onto the corners of the lattice simplex
/// around its feature, B blurs along the lattice, S interpolates (Adams et al. 2010; Kraehenbuehl and Koltun 2011).
/// Only vertices that a point touches exist, so what is splatted beyond them is lost: the sums are 0.8 (D = 3) and 0.5
/// to 0.6 (D = 6) of the exact ones. The normalised filter (K in) / (K 1) does not suffer from it: an edge between two
/// labels comes out with a relative error of 1 to 4 % (D = 3) and 1 to 5 % (D = 6), see permutohedral_lattice_test.
///
/// Results are bit-identical for any number of threads. An object keeps its memory from one build to the next.
/// D is 3 or 6. Points that follow each other should be near each other: speed depends on it, not the result.
template <int D>
class PermutohedralLattice {
 public:
  using Feature = LatticeFeature<D>;
  using Corners = LatticeCorners<D>;
  static constexpr std::size_t kChunkPoints = kLatticeChunkPoints;

  void Build(std::span<const Feature> features, ThreadPool& pool);

  /// Scales the corners' weights so that K becomes weight * D^-1/2 K D^-1/2 with D = diag(K 1). From then on splatting,
  /// blurring and slicing with corners() alone give K. Once a build.
  void Normalize(float weight, ThreadPool& pool);

  /// in and out: [point][channel]. They may be the same array.
  void Filter(std::span<const float> in, std::size_t channels, std::span<float> out, ThreadPool& pool) const;

  [[nodiscard]] std::size_t num_points() const { return corners_.size(); }
  [[nodiscard]] std::size_t num_chunks() const { return (num_points() + kChunkPoints - 1) / kChunkPoints; }
  [[nodiscard]] const LatticeGraph& graph() const { return graph_; }
  [[nodiscard]] const Corners* corners() const { return corners_.data(); }

 private:
  GrowBuffer<Corners> corners_;
  LatticeGraph graph_;
  float slice_factor_ = 1;  ///< makes K what the Gaussian sums are; 1 once Normalize has put it into the weights
};

extern template class PermutohedralLattice<3>;
extern template class PermutohedralLattice<6>;

}  // namespace dhpmap
