// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/map_registry.h"

#include <chrono>
#include <utility>

namespace dhpmap {
namespace {

Status NoSuchMap(const std::string& name) {
  return NotFound("there is no map '" + name.substr(0, 80) + "'").WithReason("MAP_NOT_FOUND");
}

std::int64_t Now(const SessionOptions& options) {
  if (options.now_ns) return options.now_ns();
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

}  // namespace

Result<std::unique_ptr<MapRegistry>> MapRegistry::Open(MapStore& store, SessionOptions options) {
  DHPMAP_ASSIGN_OR_RETURN(std::vector<StoredMap> maps, store.ListMaps());
  std::unique_ptr<MapRegistry> registry(new MapRegistry(store, std::move(options)));
  for (StoredMap& map : maps) {
    auto entry = std::make_shared<Entry>();
    entry->exists = true;
    entry->stored = {.info = std::move(map.info), .num_submaps = map.num_submaps, .damage = std::move(map.damage)};
    const std::string name = entry->stored.info.name;
    registry->entries_.emplace(name, std::move(entry));
  }
  return registry;
}

MapRegistry::~MapRegistry() { (void)Shutdown(); }

Result<MapSummary> MapRegistry::Create(MapInfo info) {
  DHPMAP_RETURN_IF_ERROR(ValidateMapName(info.name));
  const std::string name = info.name;
  info.create_time_ns = Now(options_);
  auto entry = std::make_shared<Entry>();
  const std::lock_guard busy(entry->busy);
  {
    const std::lock_guard lock(mutex_);
    if (!entries_.emplace(name, entry).second) {
      return AlreadyExists("there is a map '" + name + "' already").WithReason("MAP_EXISTS");
    }
  }
  Map map(std::move(info));
  const auto snapshot = map.Publish(map.info().create_time_ns);
  const Status status = store_.CreateMap(*snapshot);
  if (!status.ok()) {
    const std::lock_guard lock(mutex_);
    entries_.erase(name);
    return status;
  }
  MapSummary summary{.info = snapshot->info(), .num_submaps = static_cast<std::int64_t>(snapshot->submaps().size())};
  const std::lock_guard lock(mutex_);
  entry->exists = true;
  entry->stored = summary;
  return summary;
}

Result<MapSummary> MapRegistry::Get(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(name);
  if (found == entries_.end() || !found->second->exists) return NoSuchMap(name);
  MapSummary summary = Summarise(*found->second);
  if (!summary.damage.ok()) return summary.damage;
  return summary;
}

std::vector<MapSummary> MapRegistry::List() const {
  const std::lock_guard lock(mutex_);
  std::vector<MapSummary> summaries;
  for (const auto& [name, entry] : entries_) {
    if (entry->exists) summaries.push_back(Summarise(*entry));
  }
  return summaries;
}

Result<std::int64_t> MapRegistry::Delete(const std::string& name) {
  const auto entry = FindEntry(name);
  if (entry == nullptr) return NoSuchMap(name);
  const std::lock_guard busy(entry->busy);
  std::shared_ptr<MapSession> session;
  {
    const std::lock_guard lock(mutex_);
    if (!entry->exists) return NoSuchMap(name);
    session = entry->session;
  }
  DHPMAP_RETURN_IF_ERROR(session ? session->DeleteFromStore() : store_.DeleteMap(name));
  std::int64_t revision = 0;
  {
    const std::lock_guard lock(mutex_);
    revision = Summarise(*entry).info.revision;
    entry->exists = false;
    entry->session = nullptr;
    entries_.erase(name);
  }
  if (session) (void)session->Stop();  // here, where none of its own threads can be the one that must join them
  return revision;
}

Result<std::shared_ptr<MapSession>> MapRegistry::OpenSession(const std::string& name) {
  const auto entry = FindEntry(name);
  if (entry == nullptr) return NoSuchMap(name);
  {
    const std::lock_guard lock(mutex_);
    if (entry->session) return entry->session;
  }
  const std::lock_guard busy(entry->busy);
  {
    const std::lock_guard lock(mutex_);
    if (!entry->exists) return NoSuchMap(name);
    if (entry->session) return entry->session;
    if (!entry->stored.damage.ok()) return entry->stored.damage;
  }
  DHPMAP_ASSIGN_OR_RETURN(std::shared_ptr<const MapSnapshot> snapshot, store_.LoadMap(name));
  auto session = Install(*entry, std::move(snapshot));
  if (session == nullptr) return Unavailable("the server is shutting down").WithReason("SHUTTING_DOWN");
  return session;
}

Result<std::int64_t> MapRegistry::DiskBytes(const std::string& name) {
  DHPMAP_ASSIGN_OR_RETURN(const StoredMap map, store_.GetMap(name));
  return map.blob_bytes;
}

std::vector<std::shared_ptr<MapSession>> MapRegistry::OpenSessions() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<MapSession>> sessions;
  for (const auto& [name, entry] : entries_) {
    if (entry->session) sessions.push_back(entry->session);
  }
  return sessions;
}

Status MapRegistry::Shutdown() {
  {
    const std::lock_guard lock(mutex_);
    is_shut_down_ = true;
  }
  Status outcome;
  for (const auto& session : OpenSessions()) {
    if (const Status stored = session->Stop(); !stored.ok()) outcome = stored;
  }
  return outcome;
}

std::shared_ptr<MapRegistry::Entry> MapRegistry::FindEntry(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(name);
  return found == entries_.end() ? nullptr : found->second;
}

MapSummary MapRegistry::Summarise(const Entry& entry) {
  if (entry.session == nullptr) return entry.stored;
  const auto view = entry.session->View();
  return {.info = view->snapshot().info(), .num_submaps = static_cast<std::int64_t>(view->snapshot().submaps().size())};
}

std::shared_ptr<MapSession> MapRegistry::Install(Entry& entry, std::shared_ptr<const MapSnapshot> snapshot) {
  auto session = std::make_shared<MapSession>(std::move(snapshot), store_, options_);
  const std::lock_guard lock(mutex_);
  if (is_shut_down_) return nullptr;
  entry.session = session;
  return session;
}

}  // namespace dhpmap
