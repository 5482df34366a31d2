// SPDX-License-Identifier: BSD-3-Clause
// Verification and repair of stored maps.
#include "mapping/base/guarded.h"
#include "server/app/maps/map_registry.h"

namespace dhpmap {

Result<VerifyReport> MapRegistry::Verify(const std::string& name, bool repair, const std::stop_token& stop) {
  constexpr bool kRepair = true;
  if (!repair) {
    auto report = store_.VerifyMap(name, !kRepair, stop);
    if (!report.ok()) return WithSuggestion(report.status(), name);
    return report;
  }
  const Place place(*this, name);
  // An open map may be damaged in voxels that were not read yet.
  if (map_options_.pages.budget_bytes > 0 && FindOpen(name) != nullptr) {
    auto looked_at = store_.VerifyMap(name, !kRepair, stop);
    if (!looked_at.ok() || looked_at->num_faults == 0) return looked_at;
    CloseIfAtRest(*place, Clock::time_point::max(), Closing::kEvenViewed);
  }
  const MutexLock busy(place->busy);  // the map cannot be opened meanwhile
  bool is_open = false;
  {
    const MutexLock lock(mutex_);
    is_open = place->open_map != nullptr;
    place->is_repaired = !is_open;
  }
  auto report = Guarded<Result<VerifyReport>>([&] { return store_.VerifyMap(name, !is_open, stop); });
  {
    const MutexLock lock(mutex_);
    place->is_repaired = false;
    summaries_.Forget(name);
  }
  if (!report.ok()) return WithSuggestion(report.status(), name);
  return report;
}

Result<std::int64_t> MapRegistry::DiskBytes(const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(const StoredMap map, store_.GetMap(name));
  return map.blob_bytes;
}

}  // namespace dhpmap
