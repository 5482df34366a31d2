// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/voxels/block_table.h"

namespace dhpmap {

/// One layer of a tile: its blocks, by ascending cell. None is null.
template <typename Block>
struct LayerBlock {
  int cell = 0;
  std::shared_ptr<const Block> block;
};
template <typename Block>
using LayerBlocks = std::vector<LayerBlock<Block>>;

/// Bit c: there is a block at cell c.
template <typename Block>
std::uint64_t CellsOf(const LayerBlocks<Block>& blocks) {
  std::uint64_t cells = 0;
  for (const auto& entry : blocks) cells |= std::uint64_t{1} << entry.cell;
  return cells;
}

/// The cells that are set, ascending: a range.
class CellsIn {
 public:
  class Iterator {
   public:
    explicit Iterator(std::uint64_t left) : left_(left) {}
    int operator*() const { return std::countr_zero(left_); }
    Iterator& operator++() {
      left_ &= left_ - 1;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return left_ != other.left_; }

   private:
    std::uint64_t left_;
  };

  explicit CellsIn(std::uint64_t cells) : cells_(cells) {}
  [[nodiscard]] Iterator begin() const { return Iterator(cells_); }
  [[nodiscard]] static Iterator end() { return Iterator(0); }

 private:
  std::uint64_t cells_;
};

}  // namespace dhpmap
