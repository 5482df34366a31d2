// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/crf/lattice_builder.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "mapping/base/cache_line.h"
#include "mapping/base/scratch_loop.h"

namespace dhpmap {
namespace {

// Sizes of work items: fixed, so that results do not depend on the number of threads.
constexpr std::size_t kPieceRows = 8192;
constexpr std::size_t kPieceGhosts = 4096;

}  // namespace

/// The working memory of one thread. Numbers the keys of a chunk in order of appearance.
template <int D>
struct alignas(kCacheLineBytes) LatticeBuilder<D>::Lane {
  ScratchVector<std::uint16_t> slots = ScratchVector<std::uint16_t>(2048, kFree);
  ScratchVector<std::uint32_t> hashes;  ///< by number
  ScratchVector<Key> keys;              ///< by number
  // Keys of all chunks of the lane, in blocks large enough not to fragment the heap.
  std::vector<GrowBuffer<Key>> blocks;
  std::size_t block_used = 0;

  static_assert(kLatticeChunkPoints * (D + 1) < std::numeric_limits<std::uint16_t>::max());
  static constexpr std::uint16_t kFree = std::numeric_limits<std::uint16_t>::max();

  void Clear() {
    std::fill(slots.begin(), slots.end(), kFree);
    hashes.clear();
    keys.clear();
  }

  std::uint16_t NumberOf(Key key) {
    const std::uint32_t hash = HashOfKey(key);
    std::size_t slot = hash & (slots.size() - 1);
    for (; slots[slot] != kFree; slot = (slot + 1) & (slots.size() - 1)) {
      if (keys[slots[slot]] == key) return slots[slot];
    }
    const auto number = static_cast<std::uint16_t>(keys.size());
    slots[slot] = number;
    keys.push_back(key);
    hashes.push_back(hash);
    if (2 * keys.size() > slots.size()) Grow();
    return number;
  }

  void Grow() {
    slots.assign(2 * slots.size(), kFree);
    for (std::size_t number = 0; number < hashes.size(); ++number) {
      std::size_t slot = hashes[number] & (slots.size() - 1);
      while (slots[slot] != kFree) slot = (slot + 1) & (slots.size() - 1);
      slots[slot] = static_cast<std::uint16_t>(number);
    }
  }

  /// Moves the keys to permanent memory. `most_keys`: upper limit of the keys still to come.
  std::span<const Key> Keep(std::size_t most_keys) {
    constexpr std::size_t kBlockKeys = (std::size_t{8} << 20) / sizeof(Key);
    if (blocks.empty() || block_used + keys.size() > blocks.back().size()) {
      blocks.emplace_back().Resize(std::min(most_keys, kBlockKeys));
      block_used = 0;
    }
    Key* kept = blocks.back().data() + block_used;
    std::copy(keys.begin(), keys.end(), kept);
    block_used += keys.size();
    return {kept, keys.size()};
  }
};

template <int D>
LatticeBuilder<D>::LatticeBuilder(ThreadPool& pool) : pool_(pool) {}
template <int D>
LatticeBuilder<D>::~LatticeBuilder() = default;

template <int D>
void LatticeBuilder<D>::FindCorners(std::span<const LatticeFeature<D>> features, std::size_t chunk_points,
                                    LatticeCorners<D>* corners, LatticeGraph& graph) {
  const LatticeEmbedding<D> embedding;
  const std::size_t num_chunks = (features.size() + chunk_points - 1) / chunk_points;
  chunks_.resize(num_chunks);
  ParallelForWithScratch(pool_, num_chunks, lanes_, [&](std::size_t chunk, Lane& lane) {
    lane.Clear();
    Simplex<D> simplex;
    const std::size_t begin = chunk * chunk_points, end = std::min(features.size(), begin + chunk_points);
    for (std::size_t i = begin; i < end; ++i) {
      embedding.Embed(features[i], simplex);
      corners[i].scale = 1.0f / kCornerWeightSum;
      for (std::size_t k = 0; k <= D; ++k) {
        const float weight = std::clamp(simplex.weights[k], 0.0f, 1.0f) * kCornerWeightSum + 0.5f;
        corners[i].weight[k] = static_cast<std::uint16_t>(weight);
        corners[i].row[k] = lane.NumberOf(simplex.keys[k]);
      }
    }
    chunks_[chunk].keys = lane.Keep((features.size() - begin) * (D + 1));
    SortByPart(chunks_[chunk]);
  });
  graph.chunk_row.assign(num_chunks + 1, 0);
  for (std::size_t c = 0; c < num_chunks; ++c) graph.chunk_row[c + 1] = graph.chunk_row[c] + chunks_[c].keys.size();
}

template <int D>
void LatticeBuilder<D>::SortByPart(ChunkRows& rows) const {
  std::array<std::uint32_t, kNumParts + 1> at{};
  for (const Key& key : rows.keys) ++at[PartOf(HashOfKey(key)) + 1];
  for (std::size_t part = 0; part < kNumParts; ++part) at[part + 1] += at[part];
  rows.part_begin = at;
  rows.by_part.resize(rows.keys.size());
  for (std::size_t row = 0; row < rows.keys.size(); ++row) {
    rows.by_part[at[PartOf(HashOfKey(rows.keys[row]))]++] = static_cast<std::uint16_t>(row);
  }
}

template <int D>
void LatticeBuilder<D>::JoinChunks(LatticeGraph& graph) {
  GatherKeys(graph);
  pool_.ParallelFor(kNumParts, [&](std::size_t part) { JoinPart(part, graph); });
  CollectGhosts(graph);
}

template <int D>
void LatticeBuilder<D>::GatherKeys(const LatticeGraph& graph) {
  keys_.Resize(graph.num_rows());
  vertex_.Resize(graph.num_rows());
  pool_.ParallelFor(chunks_.size(), [&](std::size_t c) {
    std::copy(chunks_[c].keys.begin(), chunks_[c].keys.end(), keys_.begin() + graph.chunk_row[c]);
  });
  for (std::size_t part = 0; part < kNumParts; ++part) {
    std::size_t num_rows = 0;
    for (const ChunkRows& chunk : chunks_) num_rows += chunk.part_begin[part + 1] - chunk.part_begin[part];
    table_begin_[part + 1] = table_begin_[part] + std::bit_ceil(num_rows + num_rows / 2 + 1);
  }
  table_.Resize(table_begin_[kNumParts]);
}

template <int D>
void LatticeBuilder<D>::JoinPart(std::size_t part, const LatticeGraph& graph) {
  Entry* table = table_.data() + table_begin_[part];
  const std::size_t mask = table_begin_[part + 1] - table_begin_[part] - 1;
  std::fill(table, table + mask + 1, Entry{0, kNone});
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    for (std::uint32_t i = chunks_[c].part_begin[part]; i < chunks_[c].part_begin[part + 1]; ++i) {
      const auto row = static_cast<std::uint32_t>(graph.chunk_row[c] + chunks_[c].by_part[i]);
      const std::uint32_t hash = HashOfKey(keys_[row]);
      std::size_t slot = hash & mask;
      while (table[slot].row != kNone && (table[slot].hash != hash || keys_[table[slot].row] != keys_[row])) {
        slot = (slot + 1) & mask;
      }
      if (table[slot].row == kNone) table[slot] = {hash, row};
      vertex_[row] = table[slot].row;
    }
  }
}

template <int D>
void LatticeBuilder<D>::CollectGhosts(LatticeGraph& graph) const {
  // Counting sort by the number of ghosts of each vertex.
  ScratchVector<std::uint32_t> begin(graph.num_rows() + 1, 0);
  std::size_t num_ghosts = 0;
  for (std::size_t row = 0; row < graph.num_rows(); ++row) {
    if (vertex_[row] == row) continue;
    ++begin[vertex_[row] + 1];
    ++num_ghosts;
  }
  graph.num_vertices = graph.num_rows() - num_ghosts;
  for (std::size_t row = 0; row < graph.num_rows(); ++row) begin[row + 1] += begin[row];
  graph.ghosts.Resize(num_ghosts);
  for (std::size_t row = 0; row < graph.num_rows(); ++row) {
    if (vertex_[row] != row) graph.ghosts[begin[vertex_[row]]++] = {vertex_[row], static_cast<std::uint32_t>(row)};
  }
  graph.ghost_piece_begin.assign(1, 0);
  for (std::size_t i = 1; i < num_ghosts; ++i) {
    const bool is_full = i - graph.ghost_piece_begin.back() >= kPieceGhosts;
    if (is_full && graph.ghosts[i].vertex != graph.ghosts[i - 1].vertex) graph.ghost_piece_begin.push_back(i);
  }
  graph.ghost_piece_begin.push_back(num_ghosts);
}

template <int D>
const typename LatticeBuilder<D>::Entry& LatticeBuilder<D>::Slot(std::uint32_t hash) const {
  const std::size_t part = PartOf(hash);
  return table_[table_begin_[part] + (hash & (table_begin_[part + 1] - table_begin_[part] - 1))];
}

template <int D>
std::uint32_t LatticeBuilder<D>::Find(Key key, std::uint32_t hash) const {
  const std::size_t part = PartOf(hash);
  const Entry* table = table_.data() + table_begin_[part];
  const std::size_t mask = table_begin_[part + 1] - table_begin_[part] - 1;
  for (std::size_t slot = hash & mask; table[slot].row != kNone; slot = (slot + 1) & mask) {
    if (table[slot].hash == hash && keys_[table[slot].row] == key) return table[slot].row;
  }
  return kNone;
}

template <int D>
void LatticeBuilder<D>::FindNext(int axis, std::size_t begin, std::size_t end) {
  // The table is far larger than the caches, so entries are prefetched some rows ahead.
  constexpr std::size_t kBatchRows = 64;
  std::array<std::uint32_t, kBatchRows> hashes;
  for (; begin < end; begin += kBatchRows) {
    const std::size_t batch_end = std::min(end, begin + kBatchRows);
    for (std::size_t row = begin; row < batch_end; ++row) {
      if (vertex_[row] != row) continue;
      hashes[row - begin] = HashOfKey(LatticeEmbedding<D>::Next(keys_[row], axis));
      __builtin_prefetch(&Slot(hashes[row - begin]));
    }
    for (std::size_t row = begin; row < batch_end; ++row) {
      const bool is_vertex = vertex_[row] == row;
      next_[row] = is_vertex ? Find(LatticeEmbedding<D>::Next(keys_[row], axis), hashes[row - begin]) : kNone;
      if (next_[row] != kNone)
        has_previous_[next_[row]] = 1;  // a row has at most one previous row: no two threads write it
    }
  }
}

template <int D>
void LatticeBuilder<D>::ListChains(std::size_t begin, std::size_t end, ScratchVector<std::uint32_t>& listed) const {
  ScratchVector<std::uint32_t> chains = std::move(listed);  // see kCacheLineBytes
  chains.clear();
  for (std::size_t row = begin; row < end; ++row) {
    if (next_[row] == kNone || has_previous_[row] != 0) continue;
    chains.push_back(static_cast<std::uint32_t>(row) | LatticeGraph::kChainStart);
    for (std::uint32_t r = next_[row]; r != kNone; r = next_[r]) chains.push_back(r);
  }
  listed = std::move(chains);
}

template <int D>
void LatticeBuilder<D>::FindNeighbours(LatticeGraph& graph) {
  const std::size_t num_rows = graph.num_rows();
  const std::size_t num_pieces = (num_rows + kPieceRows - 1) / kPieceRows;
  graph.axes.resize(D + 1);
  next_.Resize(num_rows);
  has_previous_.Resize(num_rows);
  std::vector<ScratchVector<std::uint32_t>> chains(num_pieces);  // by the piece in which they start
  for (int a = 0; a <= D; ++a) {
    std::fill(has_previous_.begin(), has_previous_.end(), std::uint8_t{0});
    const auto end_of = [&](std::size_t piece) { return std::min(num_rows, (piece + 1) * kPieceRows); };
    pool_.ParallelFor(num_pieces, [&](std::size_t piece) { FindNext(a, piece * kPieceRows, end_of(piece)); });
    pool_.ParallelFor(num_pieces,
                      [&](std::size_t piece) { ListChains(piece * kPieceRows, end_of(piece), chains[piece]); });
    LatticeGraph::Axis& axis = graph.axes[static_cast<std::size_t>(a)];
    axis.piece_begin.assign(num_pieces + 1, 0);
    for (std::size_t p = 0; p < num_pieces; ++p) axis.piece_begin[p + 1] = axis.piece_begin[p] + chains[p].size();
    axis.chains.Resize(axis.piece_begin.back());
    pool_.ParallelFor(num_pieces, [&](std::size_t piece) {
      std::copy(chains[piece].begin(), chains[piece].end(), axis.chains.begin() + axis.piece_begin[piece]);
    });
  }
}

template class LatticeBuilder<3>;
template class LatticeBuilder<6>;

}  // namespace dhpmap
