// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/crf/spatial_order.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "mapping/base/refinement_scratch.h"

namespace dhpmap {
namespace {

/// Inserts two zeros before each of the 10 bits.
std::uint32_t SpreadBits(std::uint32_t x) {
  x = (x | (x << 16)) & 0x030000FFu;
  x = (x | (x << 8)) & 0x0300F00Fu;
  x = (x | (x << 4)) & 0x030C30C3u;
  return (x | (x << 2)) & 0x09249249u;
}

}  // namespace

std::uint32_t MortonCode(const Eigen::Vector3f& fraction) {
  std::uint32_t code = 0;
  for (int i = 0; i < 3; ++i) {
    // This form maps NaN to 0.
    const float cell = fraction[i] > 0.0f ? std::min(fraction[i] * 1024.0f, 1023.0f) : 0.0f;
    code |= SpreadBits(static_cast<std::uint32_t>(cell)) << i;
  }
  return code;
}

void SortByCode(GrowBuffer<std::uint32_t>& codes, GrowBuffer<std::uint32_t>& order, ThreadPool& pool) {
  constexpr int kBits = 10;
  constexpr std::size_t kBuckets = std::size_t{1} << kBits;
  constexpr std::size_t kPiece = 1 << 16;
  const std::size_t num_pieces = (codes.size() + kPiece - 1) / kPiece;
  ScratchVector<std::array<std::uint32_t, kBuckets>> places(num_pieces);  // first counts, then the next positions
  GrowBuffer<std::uint32_t> next_codes, next_order;
  next_codes.Resize(codes.size());
  next_order.Resize(codes.size());
  order.Resize(codes.size());
  std::iota(order.begin(), order.end(), 0u);
  for (int shift = 0; shift < 30; shift += kBits) {
    const auto for_each = [&](std::size_t piece, const auto& visit) {
      const std::size_t end = std::min(codes.size(), (piece + 1) * kPiece);
      for (std::size_t i = piece * kPiece; i < end; ++i) visit(i, places[piece][(codes[i] >> shift) & (kBuckets - 1)]);
    };
    pool.ParallelFor(num_pieces, [&](std::size_t piece) {
      places[piece].fill(0);
      for_each(piece, [](std::size_t, std::uint32_t& count) { ++count; });
    });
    std::uint32_t place = 0;
    for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
      for (auto& piece : places) place += std::exchange(piece[bucket], place);
    }
    pool.ParallelFor(num_pieces, [&](std::size_t piece) {
      for_each(piece, [&](std::size_t i, std::uint32_t& at) {
        next_codes[at] = codes[i];
        next_order[at++] = order[i];
      });
    });
    std::swap(codes, next_codes);
    std::swap(order, next_order);
  }
}

}  // namespace dhpmap
