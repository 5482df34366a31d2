// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mapping/base/status.h"

namespace dhpmap {

/// The occupied and free cells of a regular grid, as a file of OctoMap (".bt"): an OcTree of 16 levels, whose cell
/// (x, y, z) reaches from (x, y, z) * resolution_m to one more. Eight children that are the same become one leaf.
/// Thread-compatible.
class OctomapFile {
 public:
  static constexpr int kReach = 1 << 15;                  ///< cells from the origin to each side
  static constexpr std::size_t kMostCells = 200'000'000;  ///< 1.6 GB

  /// Every cell once; the others are unknown. OUT_OF_RANGE beyond kReach; RESOURCE_EXHAUSTED beyond kMostCells.
  Status Add(int x, int y, int z, bool is_occupied);
  [[nodiscard]] std::size_t num_cells() const { return cells_.size(); }
  [[nodiscard]] std::size_t num_occupied() const { return num_occupied_; }

  /// The whole file. `resolution_m`: side of a cell.
  [[nodiscard]] std::string Bytes(double resolution_m);

 private:
  std::vector<std::uint64_t> cells_;  // place along the Z-order curve, and in the lowest bit whether it is occupied
  std::size_t num_occupied_ = 0;
};

}  // namespace dhpmap
