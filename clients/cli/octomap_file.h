// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mapping/base/status.h"

namespace dhpmap {

/// Occupied and free cells of a regular grid, as an OctoMap file (".bt"): an octree of 16 levels. Cell (x, y, z) spans
/// from (x, y, z) * resolution_m to (x + 1, y + 1, z + 1) * resolution_m. Eight equal children become one leaf.
/// Thread-compatible.
class OctomapFile {
 public:
  static constexpr int kReach = 1 << 15;                  ///< cells from the origin in each direction
  static constexpr std::size_t kMostCells = 200'000'000;  ///< 1.6 GB

  /// Adds a cell, each at most once; other cells are unknown. OUT_OF_RANGE beyond kReach; RESOURCE_EXHAUSTED beyond
  /// kMostCells.
  Status Add(int x, int y, int z, bool is_occupied);
  [[nodiscard]] std::size_t num_cells() const { return cells_.size(); }
  [[nodiscard]] std::size_t num_occupied() const { return num_occupied_; }

  /// Returns the whole file. `resolution_m`: side of a cell.
  [[nodiscard]] std::string Bytes(double resolution_m);

 private:
  std::vector<std::uint64_t> cells_;  // Morton code of the cell; the lowest bit is set if it is occupied
  std::size_t num_occupied_ = 0;
};

}  // namespace dhpmap
