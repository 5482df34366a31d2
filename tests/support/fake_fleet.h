// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "storage/fleet.h"

namespace dhpmap::testing {

/// What the servers of a fake fleet share in place of a database: who owns which map. A test says so, or whoever asks
/// first for a map that is there takes it. Thread-safe.
class FakeFleetRoom {
 public:
  std::int64_t Join(std::string address) {
    const MutexLock lock(mutex_);
    const auto id = static_cast<std::int64_t>(servers_.size()) + 1;
    servers_.push_back({.id = id, .address = std::move(address), .version = "1.0", .is_alive = true});
    return id;
  }
  void SetAddress(std::int64_t server, std::string address) {
    const MutexLock lock(mutex_);
    servers_.at(static_cast<std::size_t>(server - 1)).address = std::move(address);
  }
  void SetAlive(std::int64_t server, bool is_alive) {
    const MutexLock lock(mutex_);
    servers_.at(static_cast<std::size_t>(server - 1)).is_alive = is_alive;
  }
  void AddMap(const std::string& map, std::int64_t owner) {
    const MutexLock lock(mutex_);
    MapOwner& now = owners_[map];
    now.server = owner;
    if (owner != 0) ++now.epoch;
  }
  Result<MapOwner> TakeOrFind(const std::string& map, std::int64_t me) {
    const MutexLock lock(mutex_);
    const auto found = owners_.find(map);
    if (found == owners_.end()) return NotFound("the fake fleet has no map " + map).WithReason("MAP_NOT_FOUND");
    if (found->second.server == 0) {
      found->second.server = me;
      ++found->second.epoch;
    }
    return Told(found->second, me);
  }
  std::vector<FleetServer> Servers(std::int64_t me) const {
    const MutexLock lock(mutex_);
    std::vector<FleetServer> servers = servers_;
    for (FleetServer& server : servers) {
      server.is_me = server.id == me;
      server.num_maps = std::count_if(owners_.begin(), owners_.end(),
                                      [&](const auto& entry) { return entry.second.server == server.id; });
    }
    return servers;
  }
  std::vector<OwnedMap> Owners(const std::string& after, std::size_t max, std::int64_t me) const {
    const MutexLock lock(mutex_);
    std::vector<OwnedMap> owned;
    for (auto entry = owners_.upper_bound(after); entry != owners_.end() && owned.size() < max; ++entry) {
      owned.push_back({entry->first, Told(entry->second, me)});
    }
    return owned;
  }

 private:
  [[nodiscard]] MapOwner Told(MapOwner owner, std::int64_t me) const DHPMAP_REQUIRES(mutex_) {
    owner.is_me = owner.server == me;
    if (owner.server != 0) owner.address = servers_.at(static_cast<std::size_t>(owner.server - 1)).address;
    return owner;
  }

  mutable Mutex mutex_;
  std::vector<FleetServer> servers_ DHPMAP_GUARDED_BY(mutex_);
  std::map<std::string, MapOwner> owners_ DHPMAP_GUARDED_BY(mutex_);
};

/// One server's view of the room. It knows what it has asked for, until it forgets. Thread-safe.
class FakeFleet final : public Fleet {
 public:
  explicit FakeFleet(std::shared_ptr<FakeFleetRoom> room) : room_(std::move(room)), me_(room_->Join("")) {}

  [[nodiscard]] std::int64_t me() const { return me_; }
  void SetMayAnswer(bool may_answer) { may_answer_ = may_answer; }
  [[nodiscard]] int num_asked() const { return num_asked_; }

  [[nodiscard]] FleetServer Me() const override { return room_->Servers(me_).at(static_cast<std::size_t>(me_ - 1)); }
  Result<std::vector<FleetServer>> ListServers() override { return room_->Servers(me_); }
  Result<std::vector<OwnedMap>> ListOwners(const std::string& after, std::size_t max) override {
    return room_->Owners(after, max, me_);
  }
  [[nodiscard]] std::optional<MapOwner> KnownOwner(const std::string& map) const override {
    const MutexLock lock(mutex_);
    const auto found = known_.find(map);
    return found != known_.end() ? std::optional(found->second) : std::nullopt;
  }
  Result<MapOwner> OwnerOf(const std::string& map) override {
    ++num_asked_;
    auto owner = room_->TakeOrFind(map, me_);
    const MutexLock lock(mutex_);
    if (owner.ok()) known_[map] = *owner;
    return owner;
  }
  void Forget(const std::string& map) override {
    const MutexLock lock(mutex_);
    known_.erase(map);
  }
  Status GiveUp(const std::string& map, std::int64_t to_server) override {
    room_->AddMap(map, to_server);
    Forget(map);
    return Status::Ok();
  }
  void StopTaking() override {}
  [[nodiscard]] bool MayAnswer() const override { return may_answer_; }
  void OnChange(std::function<void(const std::string&, std::int64_t)>) override {}
  void SetFollowed(std::vector<std::string>) override {}

 private:
  const std::shared_ptr<FakeFleetRoom> room_;
  const std::int64_t me_;
  std::atomic<bool> may_answer_ = true;
  std::atomic<int> num_asked_ = 0;
  mutable Mutex mutex_;
  std::map<std::string, MapOwner> known_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::testing
