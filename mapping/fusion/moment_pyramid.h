// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/fusion/plane_fit.h"
#include "mapping/fusion/segment_bundles.h"

namespace dhpmap {

/// Moments that stay where they are while more are added. Keeps its memory.
class StableMoments {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }
  PlaneMoments& operator[](std::size_t i) { return (*chunks_[i / kChunk])[i % kChunk]; }
  /// Sums of nothing.
  PlaneMoments& Add();
  void Clear() { size_ = 0; }
  [[nodiscard]] std::size_t BufferBytes() const;

 private:
  static constexpr std::size_t kChunk = 256;
  using Chunk = std::array<PlaneMoments, kChunk>;

  std::vector<std::unique_ptr<Chunk>> chunks_;
  std::size_t size_ = 0;
};

/// What planes are fitted to, for the bundles of a segment: moments of cubes of 2, 4 and 8 voxels a side (level 1 to 3)
/// in each of its blocks. The coarser ones are summed when first asked for; the same sums
/// whenever that is. Keeps its memory from segment to segment. Not thread-safe.
class MomentPyramid {
 public:
  static constexpr int kNumLevels = 3;

  /// From now on that of this segment.
  void Build(const SegmentBundles& segment);

  /// Cube of a cell's block, x fastest; null if nothing ends there. Stays where it is.
  const PlaneMoments* Find(std::size_t cell, int level, std::size_t cube);

  [[nodiscard]] std::size_t BufferBytes() const;

 private:
  static constexpr std::size_t kCubesASide = kBlockSide / 2;
  static constexpr std::uint8_t kNotSummed = 255;
  struct Block {
    std::array<std::uint8_t, kCubesASide * kCubesASide * kCubesASide>
        slot{};                                           ///< 1 + place from first_cube, 0 = nothing
    std::array<std::uint8_t, 8> coarse_slot{kNotSummed};  ///< the same from first_coarse, where that of the block lies
    std::uint32_t first_cube = 0, first_coarse = 0;
  };
  void SumUp(Block& block);

  std::vector<Block> blocks_;
  StableMoments cubes_, coarse_;
};

}  // namespace dhpmap
