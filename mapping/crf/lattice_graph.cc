// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/crf/lattice_graph.h"

#include <cstring>

#include "mapping/crf/float8.h"

namespace dhpmap {
namespace {

constexpr std::size_t kLookAhead = 16;  // rows to prefetch

/// Convolves the chains in [i, end) for the N vectors of a row that begin at `values`.
template <int N>
DHPMAP_ALWAYS_INLINE void BlurChains(const std::uint32_t* chains, std::size_t i, std::size_t end, float* values,
                                     std::size_t stride) {
  constexpr std::uint32_t kRowMask = ~LatticeGraph::kChainStart;
  while (i < end) {
    float* row = values + (chains[i] & kRowMask) * stride;
    Float8 before[N], here[N];
    for (int v = 0; v < N; ++v) {
      before[v] = Float8{};
      here[v] = Vector8(row, v).x;
    }
    for (++i; i < end && (chains[i] & LatticeGraph::kChainStart) == 0; ++i) {
      if (i + kLookAhead < end) {
        const float* ahead = values + (chains[i + kLookAhead] & kRowMask) * stride;
        for (int v = 0; v < N; v += 2) __builtin_prefetch(ahead + 8 * v, 1);
      }
      float* next_row = values + chains[i] * stride;
      for (int v = 0; v < N; ++v) {
        const Float8 next = Vector8(next_row, v).x;
        Vector8(row, v).x = here[v] + 0.5f * (before[v] + next);
        before[v] = here[v];
        here[v] = next;
      }
      row = next_row;
    }
    for (int v = 0; v < N; ++v) Vector8(row, v).x = here[v] + 0.5f * before[v];
  }
}

DHPMAP_VECTOR_CLONES
void BlurPiece(const std::uint32_t* chains, std::size_t begin, std::size_t end, float* values, std::size_t channels) {
  // Up to 4 vectors fit into registers.
  std::size_t c = 0;
  for (; c + 32 <= channels; c += 32) BlurChains<4>(chains, begin, end, values + c, channels);
  switch ((channels - c) / 8) {
    case 1: BlurChains<1>(chains, begin, end, values + c, channels); break;
    case 2: BlurChains<2>(chains, begin, end, values + c, channels); break;
    case 3: BlurChains<3>(chains, begin, end, values + c, channels); break;
    default: break;
  }
}

void BlurPieceOfScalars(const std::uint32_t* chains, std::size_t i, std::size_t end, float* values) {
  while (i < end) {
    std::size_t row = chains[i] & ~LatticeGraph::kChainStart;
    float before = 0, here = values[row];
    for (++i; i < end && (chains[i] & LatticeGraph::kChainStart) == 0; ++i) {
      const float next = values[chains[i]];
      values[row] = here + 0.5f * (before + next);
      before = here;
      here = next;
      row = chains[i];
    }
    values[row] = here + 0.5f * before;
  }
}

}  // namespace

void LatticeGraph::AddGhosts(float* values, std::size_t channels, ThreadPool& pool) const {
  pool.ParallelFor(ghost_piece_begin.size() - 1, [&](std::size_t piece) {
    for (std::size_t i = ghost_piece_begin[piece]; i < ghost_piece_begin[piece + 1]; ++i) {
      float* __restrict vertex = values + ghosts[i].vertex * channels;
      const float* __restrict ghost = values + ghosts[i].ghost * channels;
      for (std::size_t c = 0; c < channels; ++c) vertex[c] += ghost[c];
    }
  });
}

void LatticeGraph::SetGhosts(float* values, std::size_t channels, ThreadPool& pool) const {
  pool.ParallelFor(ghost_piece_begin.size() - 1, [&](std::size_t piece) {
    for (std::size_t i = ghost_piece_begin[piece]; i < ghost_piece_begin[piece + 1]; ++i) {
      std::memcpy(values + ghosts[i].ghost * channels, values + ghosts[i].vertex * channels, channels * sizeof(float));
    }
  });
}

void LatticeGraph::Blur(float* values, std::size_t channels, ThreadPool& pool) const {
  if (num_rows() == 0) return;
  AddGhosts(values, channels, pool);
  for (const Axis& axis : axes) {
    pool.ParallelFor(axis.piece_begin.size() - 1, [&](std::size_t piece) {
      const std::size_t begin = axis.piece_begin[piece], end = axis.piece_begin[piece + 1];
      if (channels == 1) {
        BlurPieceOfScalars(axis.chains.data(), begin, end, values);
      } else {
        BlurPiece(axis.chains.data(), begin, end, values, channels);
      }
    });
  }
  SetGhosts(values, channels, pool);
}

}  // namespace dhpmap
