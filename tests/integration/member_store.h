// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "storage/store.h"
#include "tests/support/lone_fleet.h"

namespace dhpmap::testing {

/// A fleet that takes no map and is told of commits by the test.
class ReadersFleet final : public LoneFleet {
 public:
  [[nodiscard]] FleetServer Me() const override { return {.id = 2, .is_alive = true, .is_me = true}; }
  Result<MapOwner> OwnerOf(const std::string&) override { return Unavailable("the owner is not asked here"); }
  void OnChange(std::function<void(const std::string&, std::int64_t)> on_change) override {
    const MutexLock lock(mutex_);
    on_change_ = std::move(on_change);
  }

  void Tell(const std::string& map, std::int64_t revision) {
    std::function<void(const std::string&, std::int64_t)> on_change;
    {
      const MutexLock lock(mutex_);
      on_change = on_change_;
    }
    if (on_change) on_change(map, revision);
  }

 private:
  Mutex mutex_;
  std::function<void(const std::string&, std::int64_t)> on_change_ DHPMAP_GUARDED_BY(mutex_);
};

/// One process' way to a store in memory that several share: with a fleet it reads, without one it writes and tells.
class MemberStore final : public MapStore {
 public:
  /// `fleet`: null for the owner of all maps, which tells `others`.
  MemberStore(MapStore& shared, Fleet* fleet, ReadersFleet* others) : shared_(shared), fleet_(fleet), others_(others) {}

  Fleet* fleet() override { return fleet_; }
  Result<std::vector<StoredMap>> ListMaps(const std::string& after, std::size_t max) override {
    return shared_.ListMaps(after, max);
  }
  Result<StoredMap> GetMap(const std::string& name) override { return shared_.GetMap(name); }
  Status CreateMap(const MapSnapshot& snapshot) override { return shared_.CreateMap(snapshot); }
  Status Commit(const StateMarks& before, const MapSnapshot& after, Durability durability) override {
    return Tell(after, shared_.Commit(before, after, durability));
  }
  Status CommitEdit(const StateMarks& before, const MapSnapshot& after, const EditRecord& edit) override {
    return Tell(after, shared_.CommitEdit(before, after, edit));
  }
  Result<ChangeList> ListChanges(const std::string& name, std::int64_t after, std::size_t max_bytes) override {
    return shared_.ListChanges(name, after, max_bytes);
  }
  Result<std::vector<LoggedEdit>> ListEdits(const std::string& name, const EditQuery& query) override {
    return shared_.ListEdits(name, query);
  }
  Result<std::optional<StoredAnswer>> FindAnswer(const std::string& name, const std::string& id) override {
    return shared_.FindAnswer(name, id);
  }
  Result<std::shared_ptr<const MapSnapshot>> LoadMap(const std::string& name) override {
    if (fleet_ != nullptr) ++num_taken;
    return shared_.LoadMap(name);
  }
  Result<StateToRead> LoadToRead(const std::string& name) override { return shared_.LoadToRead(name); }
  Result<StateToRead> ReadSince(const StateToRead& before) override { return shared_.ReadSince(before); }
  Status DeleteMap(const std::string& name) override { return shared_.DeleteMap(name); }
  Status Reserve(const std::string& name, const NumberMarks& marks) override { return shared_.Reserve(name, marks); }

  std::atomic<int> num_taken = 0;  ///< loads by the reader as if it were going to write

 private:
  Status Tell(const MapSnapshot& after, Status done) {
    if (done.ok() && others_ != nullptr) others_->Tell(after.info().name, after.revision());
    return done;
  }
  MapStore& shared_;
  Fleet* const fleet_;
  ReadersFleet* const others_;
};

}  // namespace dhpmap::testing
