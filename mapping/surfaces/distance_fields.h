// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/surfaces/cell_sight.h"
#include "mapping/surfaces/cell_slots.h"
#include "mapping/surfaces/field_store.h"
#include "mapping/surfaces/near_field.h"

namespace dhpmap {

/// A near field in one state of a map.
struct FieldCell {
  std::shared_ptr<const NearField> field;  ///< null: impossible here
  std::vector<std::uint32_t> numbers;      ///< in MapSurfaces, of the field's submaps
  CellSight sight;

  [[nodiscard]] std::size_t MemoryBytes() const {
    return sizeof(*this) + (numbers.capacity() + sight.others.capacity()) * sizeof(numbers[0]);
  }
};

/// The near fields of one state of a map, in frequently queried cells (FindFieldCell). Thread-safe, without waiting.
class DistanceFields : public CellGrid<FieldCell> {
 public:
  /// `state`: the state's number in the store.
  DistanceFields(const Eigen::AlignedBox3d& box_m, double voxel_size_m, std::shared_ptr<FieldStore> store,
                 std::uint64_t state)
      : CellGrid(box_m, voxel_size_m, store->ledger(), kEnough), store_(std::move(store)), state_(state) {}

  [[nodiscard]] const std::shared_ptr<FieldStore>& store() const { return store_; }
  [[nodiscard]] std::uint64_t state() const { return state_; }

 private:
  static constexpr std::uintptr_t kEnough = 64;  // points: a field then costs about as much as their searches

  const std::shared_ptr<FieldStore> store_;
  const std::uint64_t state_;
};

}  // namespace dhpmap
