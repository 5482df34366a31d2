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
  // Lower priority than quick calls, higher than bulk calls.
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

MapSummary SummaryOf(StoredMap map) {
  return {.info = std::move(map.info), .num_submaps = map.num_submaps, .damage = std::move(map.damage)};
}

/// Damage of one map, not of the whole store: the map exists.
bool IsDamage(const Status& status) {
  return status.code() == StatusCode::kDataLoss || status.code() == StatusCode::kFailedPrecondition;
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
      surfaces_(options_.surface_bytes),
      summaries_(store.fleet() == nullptr ? kMaxSummaries : 0) {
  if (Fleet* fleet = store_.fleet()) FollowOthers(*fleet);
}

Result<std::unique_ptr<MapRegistry>> MapRegistry::Open(MapStore& store, OpenMapOptions map_options,
                                                       const RegistryOptions& options) {
  SetPageReaderLimit({.bytes = BytesOfReaders(map_options.pages)});
  std::unique_ptr<MapRegistry> registry(new MapRegistry(store, std::move(map_options), options));
  Fleet* const fleet = store.fleet();
  if (fleet != nullptr) fleet->OnLost([to = registry.get()](const std::string& name) { to->NoteLoss(name); });
  if (registry->options_.idle_close_s > 0 || fleet != nullptr) {
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
  DHPMAP_ASSIGN_OR_RETURN(const HeldName held, HoldName(name));
  Map map(std::move(info));
  const auto snapshot = map.Publish(map.info().create_time_ns);
  DHPMAP_RETURN_IF_ERROR(store_.CreateMap(*snapshot));
  return SummaryOf(*snapshot);
}

HeldName::~HeldName() {
  if (registry_ != nullptr) registry_->GiveBack(name_);
}

Status MapRegistry::CheckIsFree(const std::string& name) const {
  {
    const MutexLock lock(mutex_);
    if (held_names_.contains(name)) return NameIsTaken(name);
  }
  return CheckIsNotThere(name);
}

Status MapRegistry::CheckIsNotThere(const std::string& name) const {
  if (FindOpen(name) != nullptr) return NameIsTaken(name);
  const Status asked = store_.GetMap(name).status();
  if (asked.code() == StatusCode::kNotFound) return Status::Ok();
  return asked.ok() || IsDamage(asked) ? NameIsTaken(name) : asked;
}

Result<HeldName> MapRegistry::HoldName(const std::string& name) {
  {
    const MutexLock lock(mutex_);
    if (is_shut_down_) return ShuttingDown();
    if (!held_names_.insert(name).second) return NameIsTaken(name);
  }
  HeldName held(*this, name);
  DHPMAP_RETURN_IF_ERROR(CheckIsNotThere(name));
  return held;
}

void MapRegistry::GiveBack(const std::string& name) {
  const MutexLock lock(mutex_);
  held_names_.erase(name);
}

Result<MapSummary> MapRegistry::Get(const std::string& name) const {
  if (const auto open_map = FindOpen(name)) return SummaryOf(open_map->View()->snapshot());
  auto stored = AskStore(name);
  if (!stored.ok()) return WithSuggestion(stored.status(), name);
  return std::move(stored->summary);
}

Result<std::vector<MapSummary>> MapRegistry::List(const std::string& after, std::size_t max) const {
  DHPMAP_ASSIGN_OR_RETURN(std::vector<StoredMap> maps, store_.ListMaps(after, max));
  std::vector<MapSummary> summaries;
  summaries.reserve(maps.size());
  for (StoredMap& map : maps) {
    const auto open_map = FindOpen(map.info.name);
    summaries.push_back(open_map != nullptr ? SummaryOf(open_map->View()->snapshot()) : SummaryOf(std::move(map)));
  }
  return summaries;
}

std::shared_ptr<const LostRevisions> MapRegistry::LostRevisionsOf(const std::string& name) const {
  {
    const MutexLock lock(mutex_);
    const auto found = entries_.find(name);
    if (found != entries_.end() && found->second->open_map != nullptr) return found->second->lost_revisions;
  }
  const auto stored = AskStore(name);
  return stored.ok() ? stored->lost_revisions : std::make_shared<const LostRevisions>();
}

Result<MapInStore> MapRegistry::AskStore(const std::string& name) const {
  std::uint64_t number = 0;
  {
    const MutexLock lock(mutex_);
    if (const MapInStore* known = summaries_.Find(name)) return *known;
    number = summaries_.number();
  }
  DHPMAP_ASSIGN_OR_RETURN(StoredMap map, store_.GetMap(name));
  auto lost = std::make_shared<const LostRevisions>(std::move(map.lost_revisions));
  MapInStore stored{.summary = SummaryOf(std::move(map)), .lost_revisions = std::move(lost)};
  const MutexLock lock(mutex_);
  summaries_.Add(name, stored, number);
  return stored;
}

Result<std::int64_t> MapRegistry::Delete(const std::string& name, const std::string& etag) {
  const Place place(*this, name);
  const MutexLock busy(place->busy);
  std::shared_ptr<OpenMap> open_map = FindOpen(name);
  MapInfo info{.name = name};
  if (open_map == nullptr) {
    auto stored = AskStore(name);
    if (!stored.ok() && !IsDamage(stored.status())) return WithSuggestion(stored.status(), name);
    if (stored.ok()) info = std::move(stored->summary.info);
  } else {
    info = open_map->View()->snapshot().info();
  }
  DHPMAP_RETURN_IF_ERROR(CheckEtag(etag, EtagOf(info), "map '" + name + "'"));
  DHPMAP_RETURN_IF_ERROR(open_map ? open_map->DeleteFromStore() : store_.DeleteMap(name));
  const std::int64_t revision = open_map ? open_map->View()->snapshot().revision() : info.revision;
  {
    const MutexLock lock(mutex_);
    place->open_map = nullptr;
    summaries_.Forget(name);
  }
  changes_.Notify(name);
  if (open_map) (void)open_map->Stop();  // here, because a map's own thread must not join itself
  open_map.reset();
  surfaces_.Forget(name);
  return revision;
}

Status MapRegistry::NoSuchMapAmongThese(const std::string& name) const {
  constexpr std::size_t kMostNames = 1000;
  const Status plain = NoSuchMap(name);
  const auto names = store_.ListMapNames("", kMostNames);
  if (!names.ok()) return plain;
  return NotFound(plain.message() + DidYouMean(name, *names)).WithReason(plain.reason());
}

Status MapRegistry::WithSuggestion(const Status& status, const std::string& name) const {
  return status.code() == StatusCode::kNotFound ? NoSuchMapAmongThese(name) : status;
}

std::shared_ptr<OpenMap> MapRegistry::FindOpen(const std::string& name) const {
  const MutexLock lock(mutex_);
  const auto found = entries_.find(name);
  return found != entries_.end() && !found->second->is_lost ? found->second->open_map : nullptr;
}

MapRegistry::Place::Place(MapRegistry& registry, const std::string& name) : registry_(registry), name_(name) {
  const MutexLock lock(registry_.mutex_);
  std::shared_ptr<Entry>& entry = registry_.entries_[name];
  if (entry == nullptr) entry = std::make_shared<Entry>();
  entry_ = entry;
  ++entry_->num_places;
}

MapRegistry::Place::~Place() {
  const MutexLock lock(registry_.mutex_);
  if (--entry_->num_places == 0 && entry_->open_map == nullptr) registry_.entries_.erase(name_);
}

}  // namespace dhpmap
