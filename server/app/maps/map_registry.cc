// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/maps/map_registry.h"

#include <chrono>
#include <utility>

#include "mapping/base/guarded.h"
#include "mapping/base/near_name.h"
#include "mapping/map/history_id.h"
#include "mapping/paging/page_reader.h"
#include "mapping/paging/tile_page.h"
#include "server/app/session/shutting_down.h"
#include "server/app/states/etag.h"

namespace dhpmap {
namespace {

Status NoSuchMap(const std::string& name) {
  return NotFound("there is no map '" + name.substr(0, 80) + "'").WithReason("MAP_NOT_FOUND");
}

Status NameIsTaken(const std::string& name) {
  return AlreadyExists("there is a map '" + name + "' already").WithReason("MAP_EXISTS");
}

std::int64_t Now(const SessionOptions& options) {
  if (options.now_ns) return options.now_ns();
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

/// One pool, one set of slots, and one budget of past states, for all maps.
SessionOptions WithShared(SessionOptions options) {
  // Nicer than who answers what is quick, and less so than who makes bulk answers.
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

MapRegistry::MapRegistry(MapStore& store, SessionOptions session, const RegistryOptions& options)
    : store_(store),
      session_options_(WithShared(std::move(session))),
      options_(options),
      changes_(store, options_.max_watchers),
      surfaces_(options_.surface_bytes) {}

Result<std::unique_ptr<MapRegistry>> MapRegistry::Open(MapStore& store, SessionOptions session,
                                                       const RegistryOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(std::vector<StoredMap> maps, store.ListMaps());
  SetPageReaderLimit({.bytes = BytesOfReaders(session.pages)});
  std::unique_ptr<MapRegistry> registry(new MapRegistry(store, std::move(session), options));
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
  info.create_time_ns = Now(session_options_);
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
  (void)Show(held, map);  // before all that may fail: it is there
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
  std::shared_ptr<MapSession> session;
  {
    const MutexLock lock(mutex_);
    if (!entry->exists) return NoSuchMap(name);
    DHPMAP_RETURN_IF_ERROR(CheckEtag(etag, EtagOf(Summarise(*entry).info), "map '" + name + "'"));
    session = entry->session;
  }
  DHPMAP_RETURN_IF_ERROR(session ? session->DeleteFromStore() : store_.DeleteMap(name));
  std::int64_t revision = 0;
  {
    const MutexLock lock(mutex_);
    revision = entry->session ? entry->session->View()->snapshot().revision() : entry->stored.info.revision;
    entry->exists = false;
    entry->session = nullptr;
    entries_.erase(name);
  }
  changes_.Notify(name);
  if (session) (void)session->Stop();  // here, where none of its own threads can be the one that must join them
  session.reset();
  surfaces_.Forget(name);
  return revision;
}

Result<std::shared_ptr<MapSession>> MapRegistry::OpenSession(const std::string& name) {
  const auto entry = FindEntry(name);
  if (entry == nullptr) {
    const MutexLock lock(mutex_);
    return NoSuchMapAmongThese(name);
  }
  {
    const MutexLock lock(mutex_);
    entry->last_used = Clock::now();
    if (entry->session) return entry->session;
    if (entry->is_repaired) {
      return ResourceExhausted("the map is being repaired: try again later").WithReason("TOO_BUSY");
    }
  }
  const MutexLock busy(entry->busy);
  {
    const MutexLock lock(mutex_);
    if (!entry->exists) return NoSuchMap(name);
    entry->last_used = Clock::now();
    if (entry->session) return entry->session;
    if (!entry->stored.damage.ok()) return entry->stored.damage;
  }
  DHPMAP_ASSIGN_OR_RETURN(std::shared_ptr<const MapSnapshot> snapshot, store_.LoadMap(name));
  auto session = Install(*entry, std::move(snapshot));
  if (session == nullptr) return ShuttingDown();
  return session;
}

bool MapRegistry::MustLoad(const std::string& name) const {
  const MutexLock lock(mutex_);
  const auto found = entries_.find(name);
  return found != entries_.end() && found->second->exists && found->second->session == nullptr;
}

Result<std::shared_ptr<const MapView>> MapRegistry::ViewOf(const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(const auto session, OpenSession(name));
  KeepPagesInBounds();
  return session->View();
}

void MapRegistry::KeepPagesInBounds() {
  const PageOptions& pages = session_options_.pages;
  if (pages.budget_bytes == 0 || ResidentBytes(pages) <= BytesToKeep(pages)) return;
  for (const auto& session : OpenSessions()) session->KeepPagesInBounds();
}

Result<std::shared_ptr<const MapView>> MapRegistry::ViewAt(const std::string& name, std::int64_t revision,
                                                           const std::string& field) {
  DHPMAP_ASSIGN_OR_RETURN(const auto session, OpenSession(name));
  KeepPagesInBounds();
  return dhpmap::ViewAt(revision, session->View(), *session->kept_states(), *LostRevisionsOf(name), field);
}

std::optional<FinishProgress> MapRegistry::FinishingOf(const std::string& name) const {
  const auto entry = FindEntry(name);
  if (entry == nullptr) return std::nullopt;
  std::shared_ptr<MapSession> session;
  {
    const MutexLock lock(mutex_);
    session = entry->session;
  }
  return session != nullptr ? session->Finishing() : std::nullopt;
}

std::shared_ptr<const MapSnapshot> MapRegistry::PresentOf(const MapSnapshot& state) const {
  const auto entry = FindEntry(state.info().name);
  if (entry == nullptr) return nullptr;
  std::shared_ptr<MapSession> session;
  {
    const MutexLock lock(mutex_);
    session = entry->session;
  }
  if (session == nullptr) return nullptr;
  auto present = session->View()->shared_snapshot();
  if (present->info().history_id != state.info().history_id) return nullptr;
  auto kept = session->kept_states()->StateAt(state.revision());
  return kept != nullptr ? kept : present;
}

std::function<Result<EditMade>(Map&)> MapRegistry::UndoOf(UndoRequest request) {
  return [this, request = std::move(request)](Map& map) -> Result<EditMade> {
    DHPMAP_ASSIGN_OR_RETURN(EditSummary summary, UndoEdits(request, store_, map));
    return EditMade{.submap = SubmapId(), .summary = std::move(summary)};
  };
}

std::function<Result<EditMade>(Map&)> MapRegistry::UndeletionOf(SubmapId id, EditConditions conditions) {
  return [this, id, conditions = std::move(conditions)](Map& map) -> Result<EditMade> {
    DHPMAP_ASSIGN_OR_RETURN(EditSummary summary, UndeleteSubmap(id, store_, map, conditions));
    return EditMade{.submap = id, .summary = std::move(summary)};
  };
}

std::function<Result<EditSummary>(SubmapId, const EditConditions&, Map&)> MapRegistry::Undeletions() {
  return [this](SubmapId id, const EditConditions& conditions, Map& map) {
    return UndeleteSubmap(id, store_, map, conditions);
  };
}

std::function<Result<EditMade>(Map&)> MapRegistry::PatchOf(MapPatch patch, EditConditions conditions) {
  return [this, patch = std::move(patch), conditions = std::move(conditions)](Map& map) -> Result<EditMade> {
    DHPMAP_RETURN_IF_ERROR(CheckExpectedRevision(conditions, map.info()));
    DHPMAP_RETURN_IF_ERROR(CheckMapNotEditedSince(conditions.expected_revision, store_, map.info().name));
    DHPMAP_RETURN_IF_ERROR(PatchMap(map, conditions.etag, patch));
    return EditMade{.submap = kUnknownSubmap, .summary = {.steps = {{EditAction::kRenameMap, kUnknownSubmap}}}};
  };
}

Result<VerifyReport> MapRegistry::Verify(const std::string& name, bool repair, const std::stop_token& stop) {
  constexpr bool kRepair = true;
  const auto entry = FindEntry(name);
  if (entry == nullptr) {
    const MutexLock lock(mutex_);
    return NoSuchMapAmongThese(name);
  }
  if (!repair) return store_.VerifyMap(name, !kRepair, stop);
  // That a map is open says nothing of voxels that nobody has read yet.
  if (session_options_.pages.budget_bytes > 0 && IsOpen(*entry)) {
    auto looked_at = store_.VerifyMap(name, !kRepair, stop);
    if (!looked_at.ok() || looked_at->num_faults == 0) return looked_at;
    CloseIfAtRest(*entry, Clock::time_point::max(), Closing::kEvenViewed);
  }
  const MutexLock busy(entry->busy);  // nobody opens it meanwhile
  bool is_open = false;
  {
    const MutexLock lock(mutex_);
    if (!entry->exists) return NoSuchMap(name);
    is_open = entry->session != nullptr;
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

/// The state is looked for on the writer: a request that is repeated is answered though it is kept no longer.
Result<std::function<Result<EditMade>(Map&)>> MapRegistry::RestorationOf(const std::string& name,
                                                                         RestoreRequest request) {
  DHPMAP_ASSIGN_OR_RETURN(const auto session, OpenSession(name));
  request.lost = *LostRevisionsOf(name);
  return std::function(
      [this, kept = session->kept_states(), request = std::move(request)](Map& map) -> Result<EditMade> {
        DHPMAP_ASSIGN_OR_RETURN(EditSummary summary, RestoreRevision(request, *kept, store_, map));
        return EditMade{.submap = request.submap.value_or(kUnknownSubmap), .summary = std::move(summary)};
      });
}

std::vector<std::shared_ptr<MapSession>> MapRegistry::OpenSessions() const {
  const MutexLock lock(mutex_);
  std::vector<std::shared_ptr<MapSession>> sessions;
  for (const auto& [name, entry] : entries_) {
    if (entry->session) sessions.push_back(entry->session);
  }
  return sessions;
}

void MapRegistry::GiveUpMapping() {
  for (const auto& session : OpenSessions()) session->GiveUpMapping();
}

Status MapRegistry::Shutdown() {
  {
    const MutexLock lock(mutex_);
    is_shut_down_ = true;
  }
  shut_down_.NotifyAll();
  closer_.Join();
  keeper_.Stop();
  Status outcome;
  for (const auto& session : OpenSessions()) {
    if (const Status stored = session->Stop(); !stored.ok()) outcome = stored;
  }
  return outcome;
}

void MapRegistry::CloserLoop() {
  const auto period =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.idle_close_s / 4));
  MutexLock lock(mutex_);
  while (!shut_down_.WaitFor(mutex_, period, [this]() DHPMAP_REQUIRES(mutex_) { return is_shut_down_; })) {
    lock.Unlock();
    TellSafely([this] { CloseIdleMaps(Clock::now()); });  // what lacks memory is closed next time
    TellSafely([this] { KeepPagesInBounds(); });
    lock.Lock();
  }
}

void MapRegistry::CloseIdleMaps(Clock::time_point now) {
  std::vector<std::shared_ptr<Entry>> open;
  {
    const MutexLock lock(mutex_);
    for (const auto& [name, entry] : entries_) {
      if (entry->session) open.push_back(entry);
    }
  }
  for (const auto& entry : open) CloseIfIdle(*entry, now);
}

bool MapRegistry::IsOpen(const Entry& entry) const {
  const MutexLock lock(mutex_);
  return entry.session != nullptr;
}

void MapRegistry::CloseIfIdle(Entry& entry, Clock::time_point now) {
  const auto limit = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.idle_close_s));
  CloseIfAtRest(entry, now - limit, Closing::kIfNotViewed);
}

void MapRegistry::CloseIfAtRest(Entry& entry, Clock::time_point used_until, Closing closing) {
  const MutexLock busy(entry.busy);  // whoever wants the map meanwhile waits, and loads it again
  std::shared_ptr<MapSession> session;
  {
    const MutexLock lock(mutex_);
    const bool is_held = entry.session.use_count() != 1;  // whoever comes next asks us, under this lock
    if (is_shut_down_ || !entry.session || is_held || entry.last_used > used_until) return;
    if (!entry.session->IsAtRest()) return;
    // What was not read yet of a state that is held goes with the next change unless that is made in this session.
    if (closing == Closing::kIfNotViewed && session_options_.pages.budget_bytes > 0 && entry.session->IsViewed())
      return;
    entry.stored = Summarise(entry);
    session = std::exchange(entry.session, nullptr);
  }
  (void)session->Stop();  // nothing is left to be stored
  const std::string name = session->View()->snapshot().info().name;
  session.reset();
  surfaces_.Forget(name);
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
  if (entry.session == nullptr) return entry.stored;
  return SummaryOf(entry.session->View()->snapshot());
}

std::shared_ptr<MapSession> MapRegistry::Install(Entry& entry, std::shared_ptr<const MapSnapshot> snapshot) {
  SessionOptions options = session_options_;
  options.publish.prepare = [this](const ShownView::State& state, std::function<void()> ready) {
    return keeper_.Note(state, std::move(ready));
  };
  options.commit.on_stored = [this, name = snapshot->info().name] { changes_.Notify(name); };
  options.on_finishing = options.commit.on_stored;
  auto session = std::make_shared<MapSession>(std::move(snapshot), store_, std::move(options));
  const MutexLock lock(mutex_);
  if (is_shut_down_) return nullptr;
  entry.session = session;
  return session;
}

}  // namespace dhpmap
