// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/surfaces/find_field_cell.h"

#include <algorithm>
#include <utility>

#include "mapping/surfaces/look_into_cell.h"
#include "mapping/surfaces/near_field_maker.h"

namespace dhpmap {
namespace {

const FieldCell* KeepField(const MapSurfaces& surfaces, DistanceFields::Slot& slot, BlockIndex block,
                           std::shared_ptr<const NearField> field) {
  auto cell = std::make_unique<FieldCell>();
  cell->field = std::move(field);
  if (cell->field == nullptr) {
    (void)surfaces.fields().Put(slot, std::move(cell));
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
  return &surfaces.fields().Put(slot, std::move(cell));
}

}  // namespace

const FieldCell* FindFieldCell(const MapSurfaces& surfaces, DistanceFields::Slot& slot, const Eigen::Vector3d& p_map) {
  const DistanceFields& fields = surfaces.fields();
  const std::shared_ptr<FieldStore>& store = fields.store();
  const std::uintptr_t enough = fields.num_enough();
  std::uintptr_t num_asked = 0;
  const FieldCell* cell = fields.Find(slot, num_asked);
  if (cell != nullptr) return cell->field == nullptr ? nullptr : cell;
  if (num_asked == 0) {
    const BlockIndex block = fields.BlockAt(p_map);
    std::shared_ptr<const NearField> known = store->Find(block, fields.state());
    return known == nullptr ? nullptr : KeepField(surfaces, slot, block, std::move(known));
  }
  // The thread that increments the counter makes the field.
  if (num_asked != enough || !slot.compare_exchange_strong(num_asked, enough + 1)) return nullptr;
  const BlockIndex block = fields.BlockAt(p_map);
  std::shared_ptr<const NearField> made;
  try {
    made = NearFieldMaker(surfaces).Make(block, store->ledger());
  } catch (...) {  // memory has run out, or pages are unreadable: another query may make it
    std::uintptr_t before = enough + 1;
    (void)slot.compare_exchange_strong(before, enough);
    throw;
  }
  if (made != nullptr) store->Put(block, fields.state(), made);
  return KeepField(surfaces, slot, block, std::move(made));
}

}  // namespace dhpmap
