// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <deque>
#include <map>
#include <string>
#include <utility>

#include "mapping/base/mutex.h"
#include "storage/change_history.h"
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

using ChangePtr = std::shared_ptr<const MapChange>;

/// A map's changes, as RecordChange and ReadChanges keep them.
class ChangeLog {
 public:
  explicit ChangeLog(std::int64_t complete_after = 0) : complete_after_(complete_after) {}

  void Add(ChangePtr change, const ChangeHistoryLimits& limits) {
    const std::int64_t now_ns = change->time_ns;
    totals_.num_bytes += static_cast<std::int64_t>(BytesOf(*change));
    ++totals_.num_changes;
    changes_.push_back(std::move(change));
    while (!changes_.empty() && IsBeyond(limits, totals_, changes_.front()->time_ns, now_ns)) {
      complete_after_ = changes_.front()->last_revision;
      totals_.num_bytes -= static_cast<std::int64_t>(BytesOf(*changes_.front()));
      --totals_.num_changes;
      changes_.pop_front();
    }
  }

  Result<ChangeList> List(const MapInfo& map, std::int64_t after_revision, std::size_t max_bytes) const {
    if (after_revision < complete_after_) return ChangesNotKept(complete_after_);
    ChangeList list{
        .history_id = map.history_id, .revision = map.revision, .complete_after = complete_after_, .changes = {}};
    const auto is_before = [](std::int64_t revision, const ChangePtr& change) {
      return revision < change->last_revision;
    };
    auto next = std::upper_bound(changes_.begin(), changes_.end(), after_revision, is_before);
    for (std::size_t num_bytes = 0; next != changes_.end() && num_bytes < max_bytes; ++next) {
      list.changes.push_back(*next);
      num_bytes += BytesOf(**next);
    }
    list.has_more = next != changes_.end();
    return list;
  }

 private:
  std::deque<ChangePtr> changes_;
  std::int64_t complete_after_;
  ChangeTotals totals_;
};

/// Snapshots are immutable and share their blocks with the writer: keeping one is storing it.
class MemoryStore final : public MapStore {
 public:
  explicit MemoryStore(const ChangeHistoryLimits& limits) : limits_(limits) {}

  Result<std::vector<StoredMap>> ListMaps() override {
    const MutexLock lock(mutex_);
    std::vector<StoredMap> maps;
    for (const auto& [name, map] : maps_) maps.push_back(Describe(*map.state));
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
    const auto [map, is_new] = maps_.emplace(name, Stored{std::make_shared<const MapSnapshot>(snapshot), ChangeLog()});
    if (!is_new) return AlreadyExists("there is already a map '" + name + "'").WithReason("MAP_EXISTS");
    map->second.changes.Add(ChangeBetween(StateMarks(), snapshot), limits_);
    return Status::Ok();
  }

  Status Commit(const StateMarks& before, const MapSnapshot& after, Durability) override {
    DHPMAP_RETURN_IF_ERROR(ValidateCommit(before.info(), after.info()));
    const MutexLock lock(mutex_);
    const auto stored = maps_.find(before.info().name);
    if (stored == maps_.end()) return NoSuchMap(before.info().name);
    const MapInfo& head = stored->second.state->info();
    DHPMAP_RETURN_IF_ERROR(ValidateBase(before.info(), head.revision, head.create_time_ns));
    if (before.revision() != after.revision()) stored->second.changes.Add(ChangeBetween(before, after), limits_);
    stored->second.state = std::make_shared<const MapSnapshot>(after);
    return Status::Ok();
  }

  Result<ChangeList> ListChanges(const std::string& name, std::int64_t after_revision, std::size_t max_bytes) override {
    const MutexLock lock(mutex_);
    const auto stored = maps_.find(name);
    if (stored == maps_.end()) return NoSuchMap(name);
    return stored->second.changes.List(stored->second.state->info(), after_revision, max_bytes);
  }

  Result<SnapshotPtr> LoadMap(const std::string& name) override {
    const MutexLock lock(mutex_);
    const auto stored = maps_.find(name);
    if (stored == maps_.end()) return NoSuchMap(name);
    return stored->second.state;
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
  struct Stored {
    SnapshotPtr state;
    ChangeLog changes;
  };

  static ChangePtr ChangeBetween(const StateMarks& before, const MapSnapshot& after) {
    return std::make_shared<const MapChange>(DescribeChange(before, after, DiffTiles(before, after)));
  }

  const ChangeHistoryLimits limits_;
  Mutex mutex_;
  std::map<std::string, Stored> maps_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace

std::unique_ptr<MapStore> MakeMemoryStore(const ChangeHistoryLimits& changes) {
  return std::make_unique<MemoryStore>(changes);
}

}  // namespace dhpmap
