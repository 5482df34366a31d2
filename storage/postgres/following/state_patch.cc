// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/following/state_patch.h"

#include <utility>
#include <vector>

namespace dhpmap::postgres {

Status StatePatch::Read(Connection& connection) {
  DHPMAP_RETURN_IF_ERROR(ReadRows(connection));
  DHPMAP_RETURN_IF_ERROR(ReadChangedTiles(connection));
  return ReadWhole(connection);
}

Result<std::shared_ptr<const MapSnapshot>> StatePatch::Make() {
  std::vector<std::shared_ptr<const Submap>> submaps;
  const MapSnapshot& before = *before_.snapshot;
  for (const auto& submap : before.submaps()) {
    if (!places_.owners().contains(std::int64_t{submap->id().value})) submaps_[submap->id().value] = submap;
  }
  for (auto& [id, row] : rows_) {
    if (whole_.contains(id)) continue;
    DHPMAP_ASSIGN_OR_RETURN(submaps_[id], patches_.at(id).Apply(*before.Find(row.info.id), row, pool_));
  }
  for (auto& submap : submaps_) submaps.push_back(std::move(submap.second));
  const auto free_space = free_->Finish(before.free_space()), vacated = vacated_->Finish(before.noted_vacated());
  const std::size_t num_tiles = free_space->tiles().size() + vacated->tiles().size();
  if (static_cast<std::int64_t>(submaps.size()) != map_.num_submaps ||
      static_cast<std::int64_t>(num_tiles) != map_.tiles.num_rows) {
    return DataLoss("what was committed leads to another state");
  }
  const auto& labels = before.info().label_set;
  if (*map_.info.label_set == *labels) map_.info.label_set = labels;
  return std::make_shared<const MapSnapshot>(std::move(map_.info), std::move(submaps), free_space,
                                             VacatedSpace{vacated, map_.leaving()});
}

}  // namespace dhpmap::postgres
