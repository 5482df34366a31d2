// SPDX-License-Identifier: BSD-3-Clause
// Verification and repair of stored maps.
#include <utility>

#include "mapping/base/guarded.h"
#include "server/app/maps/map_registry.h"
#include "server/app/maps/no_such_map.h"

namespace dhpmap {

Result<VerifyReport> MapRegistry::Verify(const std::string& name, bool repair, const std::stop_token& stop) {
  constexpr bool kRepair = true;
  const auto entry = FindEntry(name);
  if (entry == nullptr) {
    const MutexLock lock(mutex_);
    return NoSuchMapAmongThese(name);
  }
  if (!repair) return store_.VerifyMap(name, !kRepair, stop);
  // An open map may still have damaged voxels that were never read.
  if (map_options_.pages.budget_bytes > 0 && IsOpen(*entry)) {
    auto looked_at = store_.VerifyMap(name, !kRepair, stop);
    if (!looked_at.ok() || looked_at->num_faults == 0) return looked_at;
    CloseIfAtRest(*entry, Clock::time_point::max(), Closing::kEvenViewed);
  }
  const MutexLock busy(entry->busy);  // the map cannot be opened meanwhile
  bool is_open = false;
  {
    const MutexLock lock(mutex_);
    if (!entry->exists) return NoSuchMap(name);
    is_open = entry->open_map != nullptr;
    entry->is_repaired = !is_open;
  }
  auto report = Guarded<Result<VerifyReport>>([&] { return store_.VerifyMap(name, !is_open, stop); });
  {
    const MutexLock lock(mutex_);
    entry->is_repaired = false;
  }
  if (!report.ok() || !report->is_repaired) return report;
  DHPMAP_ASSIGN_OR_RETURN(StoredMap map, store_.GetMap(name));
  const MutexLock lock(mutex_);
  entry->stored = {.info = std::move(map.info), .num_submaps = map.num_submaps, .damage = {}};
  return report;
}

Result<std::int64_t> MapRegistry::DiskBytes(const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(const StoredMap map, store_.GetMap(name));
  return map.blob_bytes;
}

}  // namespace dhpmap
