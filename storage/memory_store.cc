// SPDX-License-Identifier: BSD-3-Clause
#include <map>
#include <string>
#include <utility>

#include "mapping/base/mutex.h"
#include "storage/commit_rules.h"
#include "storage/store.h"

namespace dhpmap {
namespace {

using SnapshotPtr = std::shared_ptr<const MapSnapshot>;

Status NoSuchMap(const std::string& name) {
  return NotFound("there is no map '" + name + "'").WithReason("MAP_NOT_FOUND");
}

StoredMap Describe(const MapSnapshot& snapshot) {
  StoredMap map{.info = snapshot.info(), .num_submaps = static_cast<std::int64_t>(snapshot.submaps().size())};
  for (const FreeSpace* layer : {snapshot.free_space().get(), snapshot.vacated().get()}) {
    for (const FreeTileEntry& entry : layer->tiles()) {
      map.blob_bytes += static_cast<std::int64_t>(entry.tile->MemoryBytes());
    }
  }
  for (const auto& submap : snapshot.submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      if (entry.tsdf) ++map.num_tsdf_blocks, map.blob_bytes += sizeof(TsdfBlock);
      if (entry.labels)
        ++map.num_label_blocks, map.blob_bytes += static_cast<std::int64_t>(entry.labels->MemoryBytes());
      if (entry.gone) map.blob_bytes += static_cast<std::int64_t>(entry.gone->MemoryBytes());
    }
  }
  return map;
}

/// Snapshots are immutable and share their blocks with the writer: keeping one is storing it.
class MemoryStore final : public MapStore {
 public:
  Result<std::vector<StoredMap>> ListMaps() override {
    const MutexLock lock(mutex_);
    std::vector<StoredMap> maps;
    for (const auto& [name, snapshot] : maps_) maps.push_back(Describe(*snapshot));
    return maps;
  }

  Result<StoredMap> GetMap(const std::string& name) override {
    DHPMAP_ASSIGN_OR_RETURN(const SnapshotPtr snapshot, LoadMap(name));
    return Describe(*snapshot);
  }

  Status CreateMap(const MapSnapshot& snapshot) override {
    DHPMAP_RETURN_IF_ERROR(ValidateMapName(snapshot.info().name));
    const MutexLock lock(mutex_);
    const std::string& name = snapshot.info().name;
    const bool is_new = maps_.emplace(name, std::make_shared<const MapSnapshot>(snapshot)).second;
    return is_new ? Status::Ok() : AlreadyExists("there is already a map '" + name + "'").WithReason("MAP_EXISTS");
  }

  Status Commit(const StateMarks& before, const MapSnapshot& after, Durability) override {
    DHPMAP_RETURN_IF_ERROR(ValidateCommit(before.info(), after.info()));
    const MutexLock lock(mutex_);
    const auto stored = maps_.find(before.info().name);
    if (stored == maps_.end()) return NoSuchMap(before.info().name);
    const MapInfo& head = stored->second->info();
    DHPMAP_RETURN_IF_ERROR(ValidateBase(before.info(), head.revision, head.create_time_ns));
    stored->second = std::make_shared<const MapSnapshot>(after);
    return Status::Ok();
  }

  Result<SnapshotPtr> LoadMap(const std::string& name) override {
    const MutexLock lock(mutex_);
    const auto stored = maps_.find(name);
    if (stored == maps_.end()) return NoSuchMap(name);
    return stored->second;
  }

  Status DeleteMap(const std::string& name) override {
    const MutexLock lock(mutex_);
    return maps_.erase(name) > 0 ? Status::Ok() : NoSuchMap(name);
  }

  /// Nothing outlives a memory store: there is no one to keep the numbers from.
  Status Reserve(const std::string& name, const NumberMarks&) override {
    const MutexLock lock(mutex_);
    return maps_.contains(name) ? Status::Ok() : NoSuchMap(name);
  }

  /// What is in memory is as it was given.
  Result<VerifyReport> VerifyMap(const std::string& name, bool, const std::stop_token&) override {
    DHPMAP_ASSIGN_OR_RETURN(const SnapshotPtr snapshot, LoadMap(name));
    VerifyReport report;
    report.revision = snapshot->revision();
    report.num_submaps = static_cast<std::int64_t>(snapshot->submaps().size());
    for (const auto& submap : snapshot->submaps()) {
      report.num_tiles += static_cast<std::int64_t>(submap->blocks().tiles().size());
      report.num_blocks += static_cast<std::int64_t>(submap->blocks().size());
    }
    return report;
  }

 private:
  Mutex mutex_;
  std::map<std::string, SnapshotPtr> maps_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace

std::unique_ptr<MapStore> MakeMemoryStore() { return std::make_unique<MemoryStore>(); }

}  // namespace dhpmap
