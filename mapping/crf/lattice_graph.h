// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/crf/grow_buffer.h"

namespace dhpmap {

/// Which rows of values a lattice has and how they are joined; what is left of it once points have found their corners.
/// Every chunk of points has rows of its own for all vertices that its points touch, so chunks can be splatted and
/// sliced side by side without sharing anything. The first row of a vertex is the vertex; its rows in later chunks are
/// ghosts, added to it after splatting and copied from it before slicing.
class LatticeGraph {
 public:
  struct Ghost {
    std::uint32_t vertex, ghost;  ///< rows
  };
  /// Neighbouring vertices along one axis, chain after chain: rows, kChainStart set on the first of each chain.
  /// Vertices without a neighbour are left out: blurring does not change them.
  struct Axis {
    GrowBuffer<std::uint32_t> chains;
    std::vector<std::size_t> piece_begin;  ///< work is cut here, at starts of chains; the last is chains.size()
  };
  static constexpr std::uint32_t kChainStart = 1u << 31;

  std::vector<std::size_t> chunk_row;  ///< first row of each chunk; the last is the number of rows
  std::size_t num_vertices = 0;
  GrowBuffer<Ghost> ghosts;                    ///< by vertex, then by ghost
  std::vector<std::size_t> ghost_piece_begin;  ///< work is cut here, between vertices
  std::vector<Axis> axes;

  [[nodiscard]] std::size_t num_rows() const { return chunk_row.empty() ? 0 : chunk_row.back(); }

  // `values` are num_rows() rows of `channels` floats; `channels` is 1 or a multiple of 8.

  /// Takes rows that chunks have splatted and leaves them ready to be sliced: adds ghosts, convolves with [1/2 1 1/2]
  /// along every axis, sets the ghosts.
  void Blur(float* values, std::size_t channels, ThreadPool& pool) const;

 private:
  void AddGhosts(float* values, std::size_t channels, ThreadPool& pool) const;
  void SetGhosts(float* values, std::size_t channels, ThreadPool& pool) const;
};

}  // namespace dhpmap
