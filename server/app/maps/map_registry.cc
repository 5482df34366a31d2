// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/maps/map_registry.h"

#include <chrono>
#include <utility>

#include "mapping/base/near_name.h"
#include "mapping/map/history_id.h"
#include "mapping/paging/page_reader.h"
#include "server/app/maps/no_such_map.h"
#include "server/app/open_map/shutting_down.h"
#include "server/app/states/etag.h"

namespace dhpmap {
namespace {

Status NameIsTaken(const std::string& name) {
  return AlreadyExists("there is a map '" + name + "' already").WithReason("MAP_EXISTS");
}

std::int64_t Now(const OpenMapOptions& options) {
  if (options.now_ns) return options.now_ns();
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

/// All maps share one thread pool, one set of slots, and one budget of past states.
OpenMapOptions WithShared(OpenMapOptions options) {
  // Nicer than threads of quick calls, less nice than those of bulk calls.
  constexpr int kFusionNiceness = 5;
  MappingOptions& mapping = options.mapping;
  if (mapping.pool == nullptr) mapping.pool = std::make_shared<ThreadPool>(mapping.num_threads, kFusionNiceness);
  if (mapping.refinement_slots == nullptr) {
    mapping.refinement_slots = std::make_shared<RefinementSlots>(mapping.pool->num_threads());
  }
  HistoryOptions& history = options.history;
  if (history.budget == nullptr) history.budget = std::make_shared<ByteBudget>(history.bytes);
  return options;
}

}  // namespace

MapSummary SummaryOf(const MapSnapshot& snapshot) {
  return {.info = snapshot.info(), .num_submaps = static_cast<std::int64_t>(snapshot.submaps().size())};
}

MapRegistry::MapRegistry(MapStore& store, OpenMapOptions map_options, const RegistryOptions& options)
    : store_(store),
      map_options_(WithShared(std::move(map_options))),
      options_(options),
      changes_(store, options_.max_watchers),
      surfaces_(options_.surface_bytes) {}

Result<std::unique_ptr<MapRegistry>> MapRegistry::Open(MapStore& store, OpenMapOptions map_options,
                                                       const RegistryOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(std::vector<StoredMap> maps, store.ListMaps());
  SetPageReaderLimit({.bytes = BytesOfReaders(map_options.pages)});
  std::unique_ptr<MapRegistry> registry(new MapRegistry(store, std::move(map_options), options));
  const MutexLock lock(registry->mutex_);
  for (StoredMap& map : maps) {
    auto entry = std::make_shared<Entry>();
    entry->exists = true;
    entry->lost_revisions = std::make_shared<const LostRevisions>(std::move(map.lost_revisions));
    entry->stored = {.info = std::move(map.info), .num_submaps = map.num_submaps, .damage = std::move(map.damage)};
    const std::string name = entry->stored.info.name;
    registry->entries_.emplace(name, std::move(entry));
  }
  if (registry->options_.idle_close_s > 0) {
    DHPMAP_RETURN_IF_ERROR(registry->closer_.Start([closer = registry.get()] { closer->CloserLoop(); }));
  }
  return registry;
}

MapRegistry::~MapRegistry() { (void)Shutdown(); }

Result<MapSummary> MapRegistry::Create(MapInfo info) {
  DHPMAP_RETURN_IF_ERROR(ValidateMapName(info.name));
  const std::string name = info.name;
  info.create_time_ns = Now(map_options_);
  info.history_id = DrawHistoryId();
  DHPMAP_ASSIGN_OR_RETURN(HeldName held, HoldName(name));
  Map map(std::move(info));
  const auto snapshot = map.Publish(map.info().create_time_ns);
  DHPMAP_RETURN_IF_ERROR(store_.CreateMap(*snapshot));
  return Show(held, SummaryOf(*snapshot));
}

HeldName::~HeldName() {
  if (registry_ != nullptr) registry_->GiveBack(name_);
}

Status MapRegistry::CheckIsFree(const std::string& name) const {
  const MutexLock lock(mutex_);
  return entries_.contains(name) ? NameIsTaken(name) : Status::Ok();
}

Result<HeldName> MapRegistry::HoldName(const std::string& name) {
  const MutexLock lock(mutex_);
  if (is_shut_down_) return ShuttingDown();
  if (!entries_.emplace(name, std::make_shared<Entry>()).second) return NameIsTaken(name);
  return HeldName(*this, name);
}

void MapRegistry::GiveBack(const std::string& name) {
  const MutexLock lock(mutex_);
  entries_.erase(name);
}

MapSummary MapRegistry::Show(HeldName& held, MapSummary map) {
  const MutexLock lock(mutex_);
  Entry& entry = *entries_.find(held.name_)->second;
  entry.exists = true;
  entry.stored = map;
  held.registry_ = nullptr;
  return map;
}

Result<MapSummary> MapRegistry::ShowStored(HeldName& held) {
  const std::string name = held.name_;
  MapSummary map;
  map.info.name = name;
  (void)Show(held, map);  // before anything that may fail, because the map exists
  const auto entry = FindEntry(name);
  Result<StoredMap> stored = store_.GetMap(name);
  if (stored.ok()) map = {.info = std::move(stored->info), .num_submaps = stored->num_submaps, .damage = {}};
  else map.damage = stored.status();
  {
    const MutexLock lock(mutex_);
    entry->stored = map;
  }
  if (!map.damage.ok()) return map.damage;
  return map;
}

Result<MapSummary> MapRegistry::Get(const std::string& name) const {
  const MutexLock lock(mutex_);
  const auto found = entries_.find(name);
  if (found == entries_.end() || !found->second->exists) return NoSuchMapAmongThese(name);
  MapSummary summary = Summarise(*found->second);
  if (!summary.damage.ok()) return summary.damage;
  return summary;
}

std::vector<MapSummary> MapRegistry::List(const std::string& after, std::size_t max) const {
  const MutexLock lock(mutex_);
  std::vector<MapSummary> summaries;
  for (auto it = entries_.upper_bound(after); it != entries_.end() && summaries.size() < max; ++it) {
    if (it->second->exists) summaries.push_back(Summarise(*it->second));
  }
  return summaries;
}

std::shared_ptr<const LostRevisions> MapRegistry::LostRevisionsOf(const std::string& name) const {
  const auto entry = FindEntry(name);
  return entry ? entry->lost_revisions : std::make_shared<const LostRevisions>();
}

Result<std::int64_t> MapRegistry::Delete(const std::string& name, const std::string& etag) {
  const auto entry = FindEntry(name);
  if (entry == nullptr) {
    const MutexLock lock(mutex_);
    return NoSuchMapAmongThese(name);
  }
  const MutexLock busy(entry->busy);
  std::shared_ptr<OpenMap> open_map;
  {
    const MutexLock lock(mutex_);
    if (!entry->exists) return NoSuchMap(name);
    DHPMAP_RETURN_IF_ERROR(CheckEtag(etag, EtagOf(Summarise(*entry).info), "map '" + name + "'"));
    open_map = entry->open_map;
  }
  DHPMAP_RETURN_IF_ERROR(open_map ? open_map->DeleteFromStore() : store_.DeleteMap(name));
  std::int64_t revision = 0;
  {
    const MutexLock lock(mutex_);
    revision = entry->open_map ? entry->open_map->View()->snapshot().revision() : entry->stored.info.revision;
    entry->exists = false;
    entry->open_map = nullptr;
    entries_.erase(name);
  }
  changes_.Notify(name);
  if (open_map) (void)open_map->Stop();  // here, because none of the map's own threads may have to join itself
  open_map.reset();
  surfaces_.Forget(name);
  return revision;
}

std::shared_ptr<MapRegistry::Entry> MapRegistry::FindEntry(const std::string& name) const {
  const MutexLock lock(mutex_);
  const auto found = entries_.find(name);
  return found == entries_.end() ? nullptr : found->second;
}

Status MapRegistry::NoSuchMapAmongThese(const std::string& name) const {
  constexpr std::size_t kMostNames = 1000;
  std::vector<std::string> names;
  for (const auto& [there, entry] : entries_) {
    if (entry->exists && names.size() < kMostNames) names.push_back(there);
  }
  const Status plain = NoSuchMap(name);
  return NotFound(plain.message() + DidYouMean(name, names)).WithReason(plain.reason());
}

MapSummary MapRegistry::Summarise(const Entry& entry) const {
  if (entry.open_map == nullptr) return entry.stored;
  return SummaryOf(entry.open_map->View()->snapshot());
}

}  // namespace dhpmap
