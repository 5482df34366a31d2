// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>
#include <utility>

#include "dhpmap/v1/fleet_service.grpc.pb.h"
#include "proto/types/resource_names.h"
#include "server/grpc/counted_service.h"
#include "server/grpc/services.h"
#include "server/wire/paging.h"
#include "storage/fleet.h"

namespace dhpmap {
namespace {

constexpr char kServers[] = "servers/";

std::string ServerName(std::int64_t id) { return kServers + std::to_string(id); }

v1::FleetServer ToProto(const FleetServer& server) {
  v1::FleetServer proto;
  proto.set_name(ServerName(server.id));
  proto.set_address(server.address);
  proto.set_version(server.version);
  proto.set_alive(server.is_alive);
  proto.set_draining(server.is_draining);
  proto.set_answering(server.is_me);
  proto.set_num_maps(server.num_maps);
  proto.set_newest_schema(server.newest_schema);
  if (server.beat_age_s) proto.set_beat_age_s(*server.beat_age_s);
  if (server.following) {
    proto.set_num_copies(server.following->num_copies);
    proto.set_copies_behind_s(server.following->behind_s);
  }
  return proto;
}

v1::FleetSchema ToProto(const FleetSchema& schema) {
  v1::FleetSchema proto;
  proto.set_in_force(schema.in_force);
  proto.set_newest(schema.newest);
  return proto;
}

v1::MapOwner ToProto(const std::string& map, const MapOwner& owner) {
  v1::MapOwner proto;
  proto.set_map(MapResourceName(map));
  if (owner.server != 0) proto.set_server(ServerName(owner.server));
  proto.set_address(owner.address);
  proto.set_epoch(owner.epoch);
  return proto;
}

/// The one that `text` means: "servers/7", "7" or an address. A server that has started anew has its address, too: the
/// living one is meant.
Result<FleetServer> FindServer(Fleet& fleet, const std::string& text) {
  DHPMAP_ASSIGN_OR_RETURN(const auto servers, fleet.ListServers());
  const std::string id = text.starts_with(kServers) ? text.substr(sizeof kServers - 1) : text;
  const FleetServer* found = nullptr;
  for (const FleetServer& server : servers) {
    const bool is_it = std::to_string(server.id) == id || server.address == text;
    if (is_it && (found == nullptr || server.is_alive)) found = &server;
  }
  if (found == nullptr) {
    return InvalidArgument("the fleet has no such server")
        .WithViolation("server", "'" + text + "' is none of GetFleet");
  }
  if (!found->is_alive) return FailedPrecondition("the server " + text + " is not alive");
  if (found->is_draining) return FailedPrecondition("the server " + text + " shuts down: it takes no more maps");
  return *found;
}

class FleetService final : public CountedService<v1::FleetService> {
 public:
  explicit FleetService(const ServiceContext& context) : CountedService(context), context_(context) {
    Take(&FleetService::GetFleet, &FleetService::FinishUpgrade, &FleetService::ListMapOwners, &FleetService::MoveMap);
  }

  // Each asks the database, as maps that are loaded do.
  grpc::ServerUnaryReactor* GetFleet(grpc::CallbackServerContext*, const v1::GetFleetRequest* request,
                                     v1::GetFleetResponse* response) override {
    return Answer({"FleetService/GetFleet", request, response}, [=](Fleet& fleet) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const auto servers, fleet.ListServers());
      for (const FleetServer& server : servers) *response->add_servers() = ToProto(server);
      *response->mutable_schema() = ToProto(fleet.Schema());
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* FinishUpgrade(grpc::CallbackServerContext*, const v1::FinishUpgradeRequest* request,
                                          v1::FinishUpgradeResponse* response) override {
    return Answer({"FleetService/FinishUpgrade", request, response}, [=](Fleet& fleet) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const FleetSchema schema, fleet.FinishUpgrade());
      *response->mutable_schema() = ToProto(schema);
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* ListMapOwners(grpc::CallbackServerContext* call, const v1::ListMapOwnersRequest* request,
                                          v1::ListMapOwnersResponse* response) override {
    return Answer({"FleetService/ListMapOwners", request, response},
                  [=, caller = CallerOf(*call)](Fleet& fleet) -> Status {
                    DHPMAP_ASSIGN_OR_RETURN(Pager pager, Pager::Begin(*request, PageMark{}));
                    DHPMAP_RETURN_IF_ERROR(AddOwners(fleet, caller, pager, *response));
                    response->set_next_page_token(pager.NextToken());
                    return Status::Ok();
                  });
  }

  grpc::ServerUnaryReactor* MoveMap(grpc::CallbackServerContext*, const v1::MoveMapRequest* request,
                                    v1::MoveMapResponse* response) override {
    return Answer({"FleetService/MoveMap", request}, [=, this](Fleet& fleet) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request->map(), "map"));
      DHPMAP_ASSIGN_OR_RETURN(const FleetServer to, FindServer(fleet, request->server()));
      DHPMAP_ASSIGN_OR_RETURN(MapOwner owner, fleet.OwnerOf(map));
      if (owner.server != to.id) {
        DHPMAP_RETURN_IF_ERROR(context_.registry.HandOver(map, to.id));
        fleet.Forget(map);
        DHPMAP_ASSIGN_OR_RETURN(owner, fleet.OwnerOf(map));
      }
      *response->mutable_owner() = ToProto(map, owner);
      return Status::Ok();
    });
  }

 private:
  grpc::ServerUnaryReactor* Answer(const CallMessages& call, const std::function<Status(Fleet&)>& work) {
    return RunAsyncIn(context_.lanes.loads, context_, call, 0,
                      [this, work](const Respond& respond, const std::stop_token&) {
                        respond(RunGuarded([&] {
                          Fleet* fleet = context_.options.fleet;
                          return fleet != nullptr ? work(*fleet) : NoFleet();
                        }));
                      });
  }

  static Status NoFleet() {
    return FailedPrecondition("the database of this server is a file, which no other server shares")
        .WithReason("NO_FLEET");
  }

  static Status AddOwners(Fleet& fleet, const Caller& caller, Pager& pager, v1::ListMapOwnersResponse& response) {
    for (std::string after = pager.after();;) {
      const std::size_t num_wanted = pager.num_wanted();
      DHPMAP_ASSIGN_OR_RETURN(const auto owned, fleet.ListOwners(after, num_wanted));
      for (const OwnedMap& map : owned) {
        after = map.map;
        if (!caller.MaySee(map.map)) continue;
        v1::MapOwner proto = ToProto(map.map, map.owner);
        if (!pager.Takes(proto, map.map)) return Status::Ok();
        *response.add_owners() = std::move(proto);
      }
      if (owned.size() < num_wanted) return Status::Ok();
    }
  }

  const ServiceContext& context_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeFleetService(const ServiceContext& context) {
  return std::make_unique<FleetService>(context);
}

}  // namespace dhpmap
