// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "tests/support/lone_fleet.h"
#include "tests/support/wrapped_store.h"

namespace dhpmap::testing {

/// A fleet that takes no map. The test reports commits to it.
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

/// A process's access to a memory store that several share. With a fleet it reads; without one it writes and reports
/// commits.
class MemberStore final : public WrappedStore {
 public:
  /// `fleet`: null for the owner of all maps, which reports commits to `others`.
  MemberStore(MapStore& shared, Fleet* fleet, ReadersFleet* others)
      : WrappedStore(shared), fleet_(fleet), others_(others) {}

  Fleet* fleet() override { return fleet_; }
  Status Commit(const StateMarks& before, const MapSnapshot& after, Durability durability) override {
    return Tell(after, inner().Commit(before, after, durability));
  }
  Status CommitEdit(const StateMarks& before, const MapSnapshot& after, const EditRecord& edit) override {
    return Tell(after, inner().CommitEdit(before, after, edit));
  }
  Result<std::shared_ptr<const MapSnapshot>> LoadMap(const std::string& name) override {
    if (fleet_ != nullptr) ++num_taken;
    return inner().LoadMap(name);
  }

  std::atomic<int> num_taken = 0;  ///< loads by the reader as if for writing

 private:
  Status Tell(const MapSnapshot& after, Status done) {
    if (done.ok() && others_ != nullptr) others_->Tell(after.info().name, after.revision());
    return done;
  }
  Fleet* const fleet_;
  ReadersFleet* const others_;
};

}  // namespace dhpmap::testing
