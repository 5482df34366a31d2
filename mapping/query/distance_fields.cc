// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/distance_fields.h"

#include <algorithm>
#include <utility>

#include "mapping/query/near_field_maker.h"
#include "mapping/query/surface_cache.h"

namespace dhpmap {

const FieldCell* DistanceFields::Find(const MapSurfaces& surfaces, Slot& slot, const Eigen::Vector3d& p_map) const {
  std::uintptr_t num_asked = 0;
  const FieldCell* cell = CellGrid::Find(slot, num_asked);
  if (cell != nullptr) return cell->field == nullptr ? nullptr : cell;
  if (num_asked == 0) {
    const BlockIndex block = BlockAt(p_map);
    std::shared_ptr<const NearField> known = store_->Find(block, state_);
    return known == nullptr ? nullptr : Keep(surfaces, slot, block, std::move(known));
  }
  // Whoever counts on makes it.
  if (num_asked != kEnough || !slot.compare_exchange_strong(num_asked, kEnough + 1)) return nullptr;
  const BlockIndex block = BlockAt(p_map);
  std::shared_ptr<const NearField> made;
  try {
    made = NearFieldMaker(surfaces).Make(block, store_->ledger());
  } catch (...) {  // there was no memory, or not all of it could be read: another one may make it
    std::uintptr_t before = kEnough + 1;
    (void)slot.compare_exchange_strong(before, kEnough);
    throw;
  }
  if (made != nullptr) store_->Put(block, state_, made);
  return Keep(surfaces, slot, block, std::move(made));
}

const FieldCell* DistanceFields::Keep(const MapSurfaces& surfaces, Slot& slot, BlockIndex block,
                                      std::shared_ptr<const NearField> field) const {
  auto cell = std::make_unique<FieldCell>();
  cell->field = std::move(field);
  if (cell->field == nullptr) {
    (void)Put(slot, std::move(cell));
    return nullptr;
  }
  const std::span<const SubmapIndex::Entry> entries = surfaces.index().entries();
  for (const SubmapId id : cell->field->submaps()) {
    const auto found = std::lower_bound(entries.begin(), entries.end(), id, [](const auto& entry, SubmapId before) {
      return entry.submap().id() < before;
    });
    cell->numbers.push_back(static_cast<std::uint32_t>(found - entries.begin()));
  }
  cell->sight = LookIntoCell(surfaces, block);
  return &Put(slot, std::move(cell));
}

}  // namespace dhpmap
