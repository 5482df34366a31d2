// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>
#include <grpcpp/server_context.h>
#include <grpcpp/support/byte_buffer.h>

#include <memory>
#include <optional>
#include <string>

#include "mapping/base/mutex.h"
#include "server/grpc/call_runner.h"
#include "server/grpc/relay/peer_channels.h"
#include "server/grpc/relay/peer_troubles.h"
#include "server/grpc/relay/route_fields.h"
#include "storage/fleet.h"

namespace dhpmap {

/// A method whose calls go to the owner of the map that they name.
struct RelayedMethod {
  const auth::CallNeeds* needs;
  RouteFields fields;
  std::string path;        ///< "/dhpmap.v1.MapService/GetMap"
  std::size_t most_bytes;  ///< of a message of a client
};

/// Which way a call goes.
struct Route {
  enum class Way {
    kHere,    ///< this server is the owner, or the call is to be refused by its handler
    kOn,      ///< to `owner`
    kAsk,     ///< the owner is not known, or not even the map
    kRefuse,  ///< with `refusal`
  };
  Way way = Way::kHere;
  bool is_passed_on = false;  ///< another server has passed it on: it goes no further
  std::string map = {};       ///< {map}; empty: not known yet
  std::optional<MapOwner> owner = {};
  Status refusal = {};
};

/// Finds the way of calls in a fleet of servers on one database. Thread-safe; outlives its calls.
class Relay {
 public:
  /// `context` has a fleet in its options, and outlives it.
  explicit Relay(const ServiceContext& context);

  /// Nothing for a method whose calls any server answers: lists over all maps, what makes maps, watches, the server
  /// itself.
  [[nodiscard]] static std::shared_ptr<const RelayedMethod> MethodOf(const auth::CallNeeds* needs,
                                                                     const google::protobuf::Descriptor& request,
                                                                     std::string path, std::size_t most_bytes);

  /// Asks nobody. `first`: the request; null: it comes in messages, none of which is there yet.
  [[nodiscard]] Route RouteOf(const RelayedMethod& method, const grpc::CallbackServerContext& call,
                              const grpc::ByteBuffer* first) const;
  /// The same of a call whose map is known, `is_asked`: of the database, which blocks.
  [[nodiscard]] Route RouteTo(std::string map, bool is_passed_on) const;
  [[nodiscard]] Route AskFor(std::string map, bool is_passed_on) const;

  /// Whether this server can prove to others for whom it asks; without keys nobody asks.
  [[nodiscard]] bool CanPassOn() const;
  /// See PeerChannels::Get.
  Result<std::shared_ptr<grpc::Channel>> ChannelTo(const std::string& address);
  /// A call to the server at `address` has ended: logs a trouble of the connection.
  void NoteEnd(const std::string& address, const grpc::Status& status);
  /// A channel to this server inside the process, for calls that turn out to be its own.
  void SetHere(std::shared_ptr<grpc::Channel> here) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::shared_ptr<grpc::Channel> Here() const DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] const ServiceContext& context() const { return context_; }
  [[nodiscard]] Fleet& fleet() const { return *context_.options.fleet; }
  [[nodiscard]] auth::Gate& gate() const { return *context_.options.gate; }

 private:
  [[nodiscard]] Status CheckPassedOn(const grpc::CallbackServerContext& call) const;
  [[nodiscard]] Route RouteFor(std::string map, bool is_passed_on, const MapOwner& owner) const;

  const ServiceContext& context_;
  PeerChannels peers_;
  PeerTroubles troubles_;
  mutable Mutex mutex_;
  std::shared_ptr<grpc::Channel> here_ DHPMAP_GUARDED_BY(mutex_);
};

/// "ADDRESS EPOCH", of kOwnerKey.
std::string OwnerText(const MapOwner& owner);
/// UNAVAILABLE, reason NOT_OWNER.
Status NotOwner(const MapOwner& owner);
/// The metadata of that key; empty if there is none.
std::string_view MetadataOf(const grpc::CallbackServerContext& call, const char* key);

}  // namespace dhpmap
