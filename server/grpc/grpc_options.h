// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"
#include "mapping/map/map_config.h"
#include "server/auth/gate.h"
#include "server/base/byte_budget.h"
#include "server/grpc/relay/peer_tls.h"

namespace dhpmap {
namespace net {
class TlsContext;
}
class Fleet;

struct GrpcOptions {
  std::string address = "127.0.0.1:50051";  ///< host:port, port 0 takes a free one; or unix:PATH
  std::vector<int> sockets = {};            ///< already listening, used in place of `address`; owned by the door then
  std::shared_ptr<const net::TlsContext> tls;  ///< null: no TLS
  std::size_t max_message_bytes = 64u << 20;   ///< limit of a request
  int num_threads = 4;                         ///< for quick calls
  int num_bulk_threads = 0;                    ///< for meshes, voxels, many points; 0: one per core
  bool has_nice_threads = true;                ///< slow work runs at low priority
  /// Budget of requests and answers in memory; calls beyond it are refused. Frames have as much again, and so have
  /// gRPC's own buffers. Never null.
  std::shared_ptr<ByteBudget> inflight = std::make_shared<ByteBudget>(256u << 20);
  int max_connections = 1000;  ///< further ones are closed at once
  double keepalive_s = 10;     ///< silence before a ping; the peer is dropped after twice that
  double import_idle_s = 30;   ///< largest lag of an uploading client behind 16 KiB/s
  /// If the state that a client reads no longer fits into memory, the client has this time to take one more message. It
  /// then receives the reason; else its connection is closed.
  double to_take_last_s = 1;
  std::int64_t max_query_points = 1'000'000;              ///< in one QueryPoints
  int max_frames_in_flight = 4;                           ///< of a stream: read, but not yet acknowledged to the client
  MapConfig default_config;                               ///< of a new map that names no preset; valid
  std::string version;                                    ///< of the server; this and the next two for GetServerStatus
  std::string database;                                   ///< path of its file
  double max_behind_s = 30;                               ///< as in CommitOptions
  std::shared_ptr<auth::Gate> gate = auth::Gate::Open();  ///< checks the callers; never null
  /// The servers that share the database. Calls about their maps are relayed to them. Null: there are none.
  Fleet* fleet = nullptr;
  PeerTls peer_tls;  ///< how to connect to them
};

/// Receives events of the handlers, for metrics. Called from many threads; each may be empty.
struct GrpcObserver {
  std::function<void(std::string_view method, StatusCode code, double seconds)> on_call;  ///< at its end
  std::function<void(std::size_t num_points)> on_query;
  std::function<void(StatusCode code)> on_frame;
  /// A call was relayed to another server of the fleet: its path "/dhpmap.v1.MapService/GetMap" and its status.
  std::function<void(std::string_view path, StatusCode code)> on_relayed;
  /// A door refused or ended a connection: the door ("grpc") and the reason ("too_many_resets").
  std::function<void(std::string_view door, std::string_view why)> on_refused;
};

}  // namespace dhpmap
