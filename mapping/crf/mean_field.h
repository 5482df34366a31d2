// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/base/cache_line.h"
#include "mapping/base/refinement_scratch.h"
#include "mapping/crf/permutohedral_lattice.h"

namespace dhpmap {

/// How labels lie in a row of values: as in the caller's rows, all kinds without a gap, padded to whole vectors of 8.
struct LabelLayout {
  /// A kind's labels in one vector, which it may share with its neighbours: elements are 0 or, where they are its own,
  /// all bits set.
  struct Part {
    int vector;
    alignas(32) std::array<std::int32_t, 8> mask;  ///< as clang reads it, whatever a type's alignment says
  };
  struct Kind {
    std::size_t begin, end;  ///< labels
    std::vector<Part> parts;
  };
  std::vector<Kind> kinds;     ///< that have labels
  std::size_t num_labels = 0;  ///< of all kinds: the length of a caller's row

  explicit LabelLayout(std::span<const int> labels_of_kinds);
  [[nodiscard]] std::size_t num_channels() const { return (num_labels + 7) / 8 * 8; }
};

/// The part of a lattice that the points of one chunk touch.
template <int D>
struct LatticeChunk {
  const typename PermutohedralLattice<D>::Corners* corners = nullptr;  ///< of the chunk's points; null: kernel off
  std::size_t num_rows = 0;
  float* rows = nullptr;  ///< in: filtered values to slice; out: splatted values
};

enum class MeanFieldPass {
  kFirst,   ///< Q = softmax(-U), splatted. Unaries that say nothing are set to 0.
  kMiddle,  ///< Q = softmax(-U + messages), splatted
  kLast,    ///< Q = softmax(-U + messages), written over U
  kOnly,    ///< Q = softmax(-U), written over U
};

/// Working memory of one thread; its contents mean nothing between passes.
struct alignas(kCacheLineBytes) MeanFieldScratch {
  ScratchVector<float> smoothness_rows, appearance_rows;  ///< what is being splatted
  ScratchVector<float> q, tails;                          ///< marginals of some points; last unaries of each
};

/// One step of mean field for one chunk of points. Slicing, softmax and splatting go point by point, so Q is never
/// kept. `order`: the indices of the chunk's points in `values`, the caller's rows: U of all points, see
/// DenseCrf::Infer.
void RunMeanFieldPass(MeanFieldPass pass, const LabelLayout& layout, std::span<const std::uint32_t> order,
                      const LatticeChunk<3>& smoothness, const LatticeChunk<6>& appearance, std::span<float> values,
                      MeanFieldScratch& scratch);

}  // namespace dhpmap
