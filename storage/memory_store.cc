// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <deque>
#include <map>
#include <string>
#include <utility>

#include "mapping/base/mutex.h"
#include "storage/commit_rules.h"
#include "storage/history/edit_tiles.h"
#include "storage/history/logged_change.h"
#include "storage/history/logged_edit.h"
#include "storage/history/seen_clock.h"
#include "storage/store.h"

namespace dhpmap {
namespace {

using SnapshotPtr = std::shared_ptr<const MapSnapshot>;

Status NoMapNamed(const std::string& name) {
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

/// The changes of a map, with the semantics of RecordChange and ReadChanges.
class ChangeLog {
 public:
  explicit ChangeLog(std::int64_t complete_after = 0) : complete_after_(complete_after) {}

  void Add(ChangePtr change, std::int64_t now_ns, const ChangeHistoryLimits& limits) {
    totals_.num_bytes += static_cast<std::int64_t>(BytesOf(*change));
    ++totals_.num_changes;
    changes_.push_back(std::move(change));
    seen_ns_.push_back(now_ns);
    while (!changes_.empty() && IsBeyond(limits, totals_, seen_ns_.front(), now_ns)) {
      complete_after_ = changes_.front()->last_revision;
      totals_.num_bytes -= static_cast<std::int64_t>(BytesOf(*changes_.front()));
      --totals_.num_changes;
      changes_.pop_front();
      seen_ns_.pop_front();
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
  std::deque<std::int64_t> seen_ns_;  ///< times of the changes
  std::int64_t complete_after_;
  ChangeTotals totals_;
};

/// The edits of a map, with the semantics of RecordEdit and ReadEdits.
class EditLog {
 public:
  void Add(const EditRecord& edit, const SnapshotPtr& after, std::int64_t now_ns, const EditLogLimits& limits) {
    num_bytes_ += BytesOf(edit);
    edits_.push_back(edit);
    edits_.back().before = nullptr;
    seen_ns_.push_back(now_ns);
    Keep(edit, after, now_ns, limits);
    for (const std::int64_t target : edit.entry.summary.targets) {
      is_undone_[target] = edit.entry.summary.kind == EditKind::kUndo;
    }
    while (edits_.size() > 1 &&
           IsBeyond(limits, static_cast<std::int64_t>(edits_.size()), num_bytes_, seen_ns_.front(), now_ns)) {
      num_bytes_ -= BytesOf(edits_.front());
      is_undone_.erase(edits_.front().entry.revision);
      histories_.erase(edits_.front().entry.revision);
      edits_.pop_front();
      seen_ns_.pop_front();
    }
  }

  [[nodiscard]] std::vector<LoggedEdit> List(const EditQuery& query) const {
    std::vector<LoggedEdit> list;
    for (auto edit = edits_.rbegin(); edit != edits_.rend() && list.size() < query.max_edits; ++edit) {
      const EditEntry& entry = edit->entry;
      if (query.before_revision && entry.revision >= *query.before_revision) continue;
      if (query.author && entry.source.author != *query.author) continue;
      const auto undone = is_undone_.find(entry.revision);
      list.push_back({.entry = entry,
                      .is_undone = undone != is_undone_.end() && undone->second,
                      .is_kept = histories_.contains(entry.revision)});
    }
    return list;
  }

  [[nodiscard]] Result<StateDelta> Load(std::int64_t revision) const {
    const auto is_it = [revision](const EditRecord& edit) { return edit.entry.revision == revision; };
    if (std::none_of(edits_.begin(), edits_.end(), is_it)) {
      return NotFound("the log of the map has no edit " + std::to_string(revision)).WithReason("EDIT_NOT_FOUND");
    }
    const auto found = histories_.find(revision);
    if (found == histories_.end()) {
      return UndoNotKept(revision, histories_.empty() ? std::nullopt : std::optional(histories_.begin()->first));
    }
    const History& history = found->second;
    StateDelta delta = DiffRows(*history.before, *history.after);
    AddTiles(*history.before, *history.after, delta);
    return delta;
  }

  [[nodiscard]] std::optional<StoredAnswer> FindAnswer(const std::string& request_id) const {
    for (auto edit = edits_.rbegin(); edit != edits_.rend() && !request_id.empty(); ++edit) {
      const EditSource& source = edit->entry.source;
      if (source.request_id != request_id) continue;
      return StoredAnswer{edit->entry.revision, source.request_fingerprint, edit->answer};
    }
    return std::nullopt;
  }

 private:
  static std::int64_t BytesOf(const EditRecord& edit) {
    const EditSummary& summary = edit.entry.summary;
    const std::size_t num_ids = summary.changed.size() + summary.created.size() + summary.removed.size();
    return LogBytesOf(edit, (summary.steps.size() * 2 + summary.targets.size() * 2 + num_ids) * sizeof(SubmapId));
  }

  /// Both states, which share equal parts. Bytes are not limited here.
  struct History {
    SnapshotPtr before, after;
    std::int64_t seen_ns = 0;
  };

  void Keep(const EditRecord& edit, const SnapshotPtr& after, std::int64_t now_ns, const EditLogLimits& limits) {
    const EditEntry& entry = edit.entry;
    if (entry.summary.kind == EditKind::kEdit) histories_[entry.revision] = {edit.before, after, now_ns};
    while (!histories_.empty() &&
           (static_cast<std::int64_t>(histories_.size()) > limits.max_histories ||
            static_cast<double>(now_ns - histories_.begin()->second.seen_ns) > limits.max_history_age_s * 1e9)) {
      histories_.erase(histories_.begin());
    }
  }

  std::deque<EditRecord> edits_;
  std::deque<std::int64_t> seen_ns_;  ///< times of the edits
  std::map<std::int64_t, History> histories_;
  std::map<std::int64_t, bool> is_undone_;
  std::int64_t num_bytes_ = 0;
};

/// Snapshots are immutable and share blocks with the writer, so keeping a snapshot stores it.
class MemoryStore final : public MapStore {
 public:
  MemoryStore(const ChangeHistoryLimits& limits, const EditLogLimits& edits, PassingTime time)
      : limits_(limits), edit_limits_(edits), time_(OrSteadyClock(std::move(time))) {}

  Result<std::vector<StoredMap>> ListMaps(const std::string& after, std::size_t max) override {
    const MutexLock lock(mutex_);
    std::vector<StoredMap> maps;
    for (auto map = maps_.upper_bound(after); map != maps_.end() && maps.size() < max; ++map) {
      const MapSnapshot& state = *map->second.state;
      maps.push_back(
          {.info = state.info(), .num_submaps = static_cast<std::int64_t>(state.submaps().size()), .damage = {}});
    }
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
    const auto [map, is_new] =
        maps_.emplace(name, Stored{std::make_shared<const MapSnapshot>(snapshot), ChangeLog(), EditLog()});
    if (!is_new) return AlreadyExists("there is already a map '" + name + "'").WithReason("MAP_EXISTS");
    NameTiles(StateMarks(), snapshot, snapshot);
    map->second.changes.Add(ChangeBetween(StateMarks(), snapshot), time_(), limits_);
    return Status::Ok();
  }

  Status Commit(const StateMarks& before, const MapSnapshot& after, Durability) override {
    return CommitState(before, after, nullptr);
  }

  Status CommitEdit(const StateMarks& before, const MapSnapshot& after, const EditRecord& edit) override {
    return CommitState(before, after, &edit);
  }

  Result<std::vector<LoggedEdit>> ListEdits(const std::string& name, const EditQuery& query) override {
    const MutexLock lock(mutex_);
    const auto stored = maps_.find(name);
    if (stored == maps_.end()) return NoMapNamed(name);
    return stored->second.edits.List(query);
  }

  Result<std::optional<StoredAnswer>> FindAnswer(const std::string& name, const std::string& request_id) override {
    const MutexLock lock(mutex_);
    const auto stored = maps_.find(name);
    if (stored == maps_.end()) return NoMapNamed(name);
    return stored->second.edits.FindAnswer(request_id);
  }

  Result<StateDelta> LoadEdit(const std::string& name, std::int64_t revision) override {
    const MutexLock lock(mutex_);
    const auto stored = maps_.find(name);
    if (stored == maps_.end()) return NoMapNamed(name);
    return stored->second.edits.Load(revision);
  }

  Result<ChangeList> ListChanges(const std::string& name, std::int64_t after_revision, std::size_t max_bytes) override {
    const MutexLock lock(mutex_);
    const auto stored = maps_.find(name);
    if (stored == maps_.end()) return NoMapNamed(name);
    return stored->second.changes.List(stored->second.state->info(), after_revision, max_bytes);
  }

  Result<SnapshotPtr> LoadMap(const std::string& name) override {
    const MutexLock lock(mutex_);
    const auto stored = maps_.find(name);
    if (stored == maps_.end()) return NoMapNamed(name);
    return stored->second.state;
  }

  Status DeleteMap(const std::string& name) override {
    const MutexLock lock(mutex_);
    return maps_.erase(name) > 0 ? Status::Ok() : NoMapNamed(name);
  }

  /// A memory store does not outlive the process, so numbers need no reservation.
  Status Reserve(const std::string& name, const NumberMarks&) override {
    const MutexLock lock(mutex_);
    return maps_.contains(name) ? Status::Ok() : NoMapNamed(name);
  }

  /// Data in memory cannot be damaged.
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
    EditLog edits;
  };

  Status CommitState(const StateMarks& before, const MapSnapshot& after, const EditRecord* edit) {
    DHPMAP_RETURN_IF_ERROR(ValidateCommit(before.info(), after.info()));
    const MutexLock lock(mutex_);
    const auto stored = maps_.find(before.info().name);
    if (stored == maps_.end()) return NoMapNamed(before.info().name);
    const MapInfo& head = stored->second.state->info();
    DHPMAP_RETURN_IF_ERROR(ValidateBase(before.info(), head.revision, head.create_time_ns));
    if (before.revision() != after.revision()) {
      const std::vector<RegionEvent> cleared = edit != nullptr ? edit->cleared : std::vector<RegionEvent>();
      stored->second.changes.Add(ChangeBetween(before, after, cleared), time_(), limits_);
    }
    NameTiles(before, after, *stored->second.state);
    stored->second.state = std::make_shared<const MapSnapshot>(after);
    if (edit != nullptr) stored->second.edits.Add(*edit, stored->second.state, time_(), edit_limits_);
    return Status::Ok();
  }

  /// Assigns a key to each written tile, as a store of blobs does.
  void NameTiles(const StateMarks& before, const MapSnapshot& after, const MapSnapshot& known) DHPMAP_REQUIRES(mutex_) {
    for (const SubmapTileChange& submap : DiffTiles(before, after)) {
      const Submap* old = known.Find(submap.copy_of.value_or(submap.id));
      for (const TileChange& tile : submap.tiles) {
        if (tile.after == nullptr) continue;
        const TileEntry* entry = old != nullptr ? old->blocks().FindTile(tile.index) : nullptr;
        for (std::size_t i = 0; i < kNumBlockLayers; ++i) {
          const StoredKey& key = tile.after->stored(static_cast<BlockLayer>(i));
          if (key.In(kNumber) != 0 || tile.num_after[i] == 0) continue;
          if (!tile.is_written[i] && entry != nullptr) key.Adopt(entry->tile->stored(static_cast<BlockLayer>(i)));
          else key.Set(kNumber, ++last_key_);
        }
      }
    }
  }

  static constexpr std::uint16_t kNumber = 0xFFFF;  ///< not used by file stores, unless there are too many

  static ChangePtr ChangeBetween(const StateMarks& before, const MapSnapshot& after,
                                 const std::vector<RegionEvent>& cleared = {}) {
    return std::make_shared<const MapChange>(DescribeChange(before, after, DiffTiles(before, after), cleared));
  }

  const ChangeHistoryLimits limits_;
  const EditLogLimits edit_limits_;
  const PassingTime time_;
  Mutex mutex_;
  std::int64_t last_key_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::map<std::string, Stored> maps_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace

std::unique_ptr<MapStore> MakeMemoryStore(const ChangeHistoryLimits& changes, const EditLogLimits& edits,
                                          std::function<std::int64_t()> passing_time_ns) {
  return std::make_unique<MemoryStore>(changes, edits, std::move(passing_time_ns));
}

}  // namespace dhpmap
