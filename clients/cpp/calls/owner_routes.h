// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>

#include <concepts>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "clients/cpp/calls/pauses.h"
#include "dhpmap/v1/auth_service.grpc.pb.h"
#include "dhpmap/v1/edit_service.grpc.pb.h"
#include "dhpmap/v1/fleet_service.grpc.pb.h"
#include "dhpmap/v1/map_service.grpc.pb.h"
#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "dhpmap/v1/query_service.grpc.pb.h"
#include "dhpmap/v1/server_service.grpc.pb.h"
#include "dhpmap/v1/submap_service.grpc.pb.h"
#include "dhpmap/v1/watch_service.grpc.pb.h"
#include "mapping/base/mutex.h"

namespace dhpmap::client {

/// The methods of one server. Thread-safe.
class Stubs {
 public:
  explicit Stubs(std::shared_ptr<grpc::Channel> channel)
      : channel_(std::move(channel)),
        stubs_(channel_, channel_, channel_, channel_, channel_, channel_, channel_, channel_, channel_) {}

  template <typename Stub>
  Stub& of() {
    return std::get<Stub>(stubs_);
  }
  [[nodiscard]] grpc::Channel& channel() const { return *channel_; }

 private:
  const std::shared_ptr<grpc::Channel> channel_;
  std::tuple<v1::AuthService::Stub, v1::EditService::Stub, v1::FleetService::Stub, v1::MapService::Stub,
             v1::MappingService::Stub, v1::QueryService::Stub, v1::ServerService::Stub, v1::SubmapService::Stub,
             v1::WatchService::Stub>
      stubs_;
};

/// The addresses of the maps' owners, learned from the answers of a fleet. Calls about a map then go directly to its
/// owner. If the owner cannot be reached from here, they go to the first server, which relays them. Thread-safe.
class OwnerRoutes {
 public:
  static constexpr std::size_t kMostServers = 16, kMostMaps = 1024;
  /// Opens a channel to that address, which connects by itself; null: the address is not allowed.
  using Dial = std::function<std::shared_ptr<grpc::Channel>(const std::string& address)>;

  /// An empty `dial` turns routing off.
  explicit OwnerRoutes(Dial dial) : dial_(std::move(dial)) {}

  /// The connected owner of maps/...; waits for the connection until `end`. Null: use the first server.
  [[nodiscard]] std::shared_ptr<Stubs> To(const std::string& map, Clock::time_point end = {}) const
      DHPMAP_EXCLUDES(mutex_);
  /// Reads the owner from a call's metadata. Call it after the first answer or the end.
  void Learn(const std::string& map, const grpc::ClientContext& context) DHPMAP_EXCLUDES(mutex_);
  void Forget(const std::string& map) DHPMAP_EXCLUDES(mutex_);

 private:
  [[nodiscard]] std::shared_ptr<Stubs> ServerAt(const std::string& address) DHPMAP_REQUIRES(mutex_);

  const Dial dial_;
  mutable Mutex mutex_;
  std::map<std::string, std::string> addresses_ DHPMAP_GUARDED_BY(mutex_);           ///< by map
  std::map<std::string, std::shared_ptr<Stubs>> servers_ DHPMAP_GUARDED_BY(mutex_);  ///< by address
};

/// "maps/{map}" of a name below it; empty for other names.
std::string MapOfName(const std::string& name);

/// The map that a request names; empty: none, or the request names it in a field unknown to this function.
template <typename Request>
std::string MapOfRequest(const Request& request) {
  if constexpr (requires {
                  { request.map() } -> std::convertible_to<std::string>;
                })
    return MapOfName(request.map());
  else if constexpr (requires { request.map().name(); }) return MapOfName(request.map().name());
  else if constexpr (requires { request.submap().name(); }) return MapOfName(request.submap().name());
  else if constexpr (requires { request.parent(); }) return MapOfName(request.parent());
  else if constexpr (requires { request.name(); }) return MapOfName(request.name());
  else return {};
}

}  // namespace dhpmap::client
