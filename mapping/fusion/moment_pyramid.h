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

/// Moments at stable addresses while more are added. Reuses its memory.
class StableMoments {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }
  PlaneMoments& operator[](std::size_t i) { return (*chunks_[i / kChunk])[i % kChunk]; }
  /// Adds empty sums.
  PlaneMoments& Add();
  void Clear() { size_ = 0; }
  [[nodiscard]] std::size_t BufferBytes() const;

 private:
  static constexpr std::size_t kChunk = 256;
  using Chunk = std::array<PlaneMoments, kChunk>;

  std::vector<std::unique_ptr<Chunk>> chunks_;
  std::size_t size_ = 0;
};

/// Moments for fitting planes to the bundles of a segment: of cubes of 2, 4 and 8 voxels a side (levels 1 to 3) in each
/// of its blocks. Coarser levels are summed at their first use, with the same result at any time. Reuses its memory
/// between segments. Not thread-safe.
class MomentPyramid {
 public:
  static constexpr int kNumLevels = 3;

  /// Starts a new segment.
  void Build(const SegmentBundles& segment);

  /// The cube `cube`, x fastest, of a cell's block; null if no bundle ends there. The address is stable.
  const PlaneMoments* Find(std::size_t cell, int level, std::size_t cube);

  [[nodiscard]] std::size_t BufferBytes() const;

 private:
  static constexpr std::size_t kCubesASide = kBlockSide / 2;
  static constexpr std::uint8_t kNotSummed = 255;
  struct Block {
    std::array<std::uint8_t, kCubesASide * kCubesASide * kCubesASide>
        slot{};                                           ///< 1 + place from first_cube, 0 = nothing
    std::array<std::uint8_t, 8> coarse_slot{kNotSummed};  ///< the same from first_coarse, by octant
    std::uint32_t first_cube = 0, first_coarse = 0;
  };
  void SumUp(Block& block);

  std::vector<Block> blocks_;
  StableMoments cubes_, coarse_;
};

}  // namespace dhpmap
