// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "storage/fleet.h"

namespace dhpmap::testing {

/// A fleet of this process alone, which owns every map; tests override what they are about.
class LoneFleet : public Fleet {
 public:
  [[nodiscard]] FleetServer Me() const override { return {.id = 1, .is_alive = true, .is_me = true}; }
  Result<std::vector<FleetServer>> ListServers() override { return std::vector{Me()}; }
  Result<std::vector<OwnedMap>> ListOwners(const std::string&, std::size_t) override { return std::vector<OwnedMap>(); }
  [[nodiscard]] std::optional<MapOwner> KnownOwner(const std::string&) const override { return std::nullopt; }
  Result<MapOwner> OwnerOf(const std::string&) override { return MapOwner{.server = Me().id, .is_me = true}; }
  void Forget(const std::string&) override {}
  Status GiveUp(const std::string&, std::int64_t) override { return Status::Ok(); }
  void StopTaking() override {}
  [[nodiscard]] bool MayAnswer() const override { return true; }
  void OnChange(std::function<void(const std::string&, std::int64_t)>) override {}
  void SetFollowed(std::vector<std::string>) override {}
};

}  // namespace dhpmap::testing
