// SPDX-License-Identifier: BSD-3-Clause
// Handing maps over to other processes on the same store, and losing maps to them.
#include <algorithm>
#include <utility>
#include <vector>

#include "mapping/base/guarded.h"
#include "server/app/maps/map_registry.h"
#include "server/app/maps/not_owner.h"

namespace dhpmap {
namespace {

/// NOT_FOUND; FAILED_PRECONDITION if the server takes no maps.
Result<FleetServer> FindTaker(Fleet& fleet, std::int64_t id) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<FleetServer> servers, fleet.ListServers());
  const auto found = std::find_if(servers.begin(), servers.end(), [&](const auto& server) { return server.id == id; });
  if (found == servers.end()) return NotFound("there is no server " + std::to_string(id));
  if (found->is_alive && !found->is_draining) return *found;
  return FailedPrecondition("server " + std::to_string(id) + (found->is_alive ? " is shutting down" : " is dead"));
}

/// Other living servers that take maps, those with the fewest maps first. Empty if the database does not answer.
std::vector<FleetServer> FindTakers(Fleet& fleet) {
  std::vector<FleetServer> takers;
  const auto servers = fleet.ListServers();
  if (!servers.ok()) return takers;
  for (const FleetServer& server : *servers) {
    if (server.is_alive && !server.is_draining && !server.is_me) takers.push_back(server);
  }
  return takers;
}

}  // namespace

Status MapRegistry::HandOver(const std::string& name, std::int64_t to_server) {
  Fleet* const fleet = store_.fleet();
  if (fleet == nullptr) {
    return FailedPrecondition("the server is the only one of its database").WithReason("NO_FLEET");
  }
  FleetServer taker;
  if (to_server != 0) {
    DHPMAP_ASSIGN_OR_RETURN(taker, FindTaker(*fleet, to_server));
    if (taker.is_me) return Status::Ok();
  }
  const Place place(*this, name);
  const MutexLock busy(place->busy);  // callers that need the map wait, and then ask for its owner
  MoveAway(name, *place, NotOwner(name, taker.address));
  return fleet->GiveUp(name, to_server);
}

Status MapRegistry::HandAllOver() {
  Fleet* const fleet = store_.fleet();
  if (fleet == nullptr) return Status::Ok();
  fleet->StopTaking();
  std::vector<FleetServer> takers = FindTakers(*fleet);
  Status outcome;
  for (const auto& open_map : OpenMaps()) {
    const auto least = std::min_element(takers.begin(), takers.end(),
                                        [](const auto& a, const auto& b) { return a.num_maps < b.num_maps; });
    std::int64_t to = 0;
    if (least != takers.end()) {
      to = least->id;
      ++least->num_maps;
    }
    const std::string name = open_map->View()->snapshot().info().name;
    Status given = HandOver(name, to);
    if (!given.ok() && to != 0) given = HandOver(name, 0);  // that server has ended meanwhile
    if (!given.ok()) outcome = std::move(given);
  }
  return outcome;
}

void MapRegistry::MoveAway(const std::string& name, Entry& entry, const Status& why) {
  std::shared_ptr<OpenMap> open_map;
  {
    const MutexLock lock(mutex_);
    open_map = std::exchange(entry.open_map, nullptr);
    entry.is_lost = false;
    lost_names_.erase(name);
    summaries_.Forget(name);
  }
  if (open_map == nullptr) return;
  (void)open_map->MoveAway(why);  // unstored frames were not acknowledged: clients send them again
  open_map.reset();
  surfaces_.Forget(name);
  changes_.Notify(name);
}

void MapRegistry::NoteLoss(const std::string& name) {
  const MutexLock lock(mutex_);
  const auto found = entries_.find(name);
  if (found == entries_.end()) return;
  found->second->is_lost = true;  // also marks a map that is being loaded
  lost_names_.insert(name);
  closer_wake_.NotifyAll();
}

void MapRegistry::CloseLostMaps() {
  std::vector<std::string> names;
  {
    const MutexLock lock(mutex_);
    names.assign(lost_names_.begin(), lost_names_.end());
  }
  for (const std::string& name : names) {
    const Place place(*this, name);
    const MutexLock busy(place->busy);
    std::shared_ptr<OpenMap> open_map;
    {
      const MutexLock lock(mutex_);
      if (place->is_lost) open_map = place->open_map;  // else it was closed or loaded again meanwhile
      lost_names_.erase(name);
    }
    if (open_map == nullptr) continue;
    const Status loss = open_map->loss();  // it may name the new owner
    open_map.reset();
    MoveAway(name, *place, loss.ok() ? NotOwner(name, "") : loss);
  }
}

}  // namespace dhpmap
