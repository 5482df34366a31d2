// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/base/refinement_scratch.h"
#include "mapping/base/thread_pool.h"
#include "mapping/crf/grow_buffer.h"
#include "mapping/crf/lattice_corners.h"
#include "mapping/crf/lattice_embedding.h"
#include "mapping/crf/lattice_graph.h"

namespace dhpmap {

/// Builds a permutohedral lattice in three steps, to be called in this order. Chunks of points first find their corners
/// on their own, with a small hash table each; what they found is then joined by parts of the keys' hash. All numbers
/// given to rows follow the order of chunks and points, never that of threads.
template <int D>
class LatticeBuilder {
 public:
  using Key = LatticeKey<D>;

  explicit LatticeBuilder(ThreadPool& pool);
  ~LatticeBuilder();

  /// Writes the corners of all points, and graph.chunk_row.
  void FindCorners(std::span<const LatticeFeature<D>> features, std::size_t chunk_points, LatticeCorners<D>* corners,
                   LatticeGraph& graph);
  /// Finds rows of different chunks that are one vertex.
  void JoinChunks(LatticeGraph& graph);
  void FindNeighbours(LatticeGraph& graph);

 private:
  static constexpr std::size_t kNumParts = 64;
  static constexpr std::uint32_t kNone = ~0u;

  /// What a chunk found: the keys of its rows, and its rows by part.
  struct ChunkRows {
    std::span<const Key> keys;
    ScratchVector<std::uint16_t> by_part;
    std::array<std::uint32_t, kNumParts + 1> part_begin;
  };
  struct Entry {
    std::uint32_t hash, row;
  };
  struct Lane;

  static std::size_t PartOf(std::uint32_t hash) { return hash >> 26; }

  void SortByPart(ChunkRows& rows) const;
  void GatherKeys(const LatticeGraph& graph);
  void JoinPart(std::size_t part, const LatticeGraph& graph);
  void CollectGhosts(LatticeGraph& graph) const;
  [[nodiscard]] const Entry& Slot(std::uint32_t hash) const;
  [[nodiscard]] std::uint32_t Find(Key key, std::uint32_t hash) const;
  void FindNext(int axis, std::size_t begin, std::size_t end);
  void ListChains(std::size_t begin, std::size_t end, ScratchVector<std::uint32_t>& listed) const;

  ThreadPool& pool_;
  std::vector<Lane> lanes_;
  ScratchVector<ChunkRows> chunks_;
  GrowBuffer<Key> keys_;              ///< of all rows
  GrowBuffer<std::uint32_t> vertex_;  ///< of all rows: the first row with the same key
  GrowBuffer<Entry> table_;           ///< open addressing, a piece of a power of two for each part
  std::array<std::size_t, kNumParts + 1> table_begin_{};
  // Along the axis in hand, for all rows.
  GrowBuffer<std::uint32_t> next_;
  GrowBuffer<std::uint8_t> has_previous_;
};

extern template class LatticeBuilder<3>;
extern template class LatticeBuilder<6>;

}  // namespace dhpmap
