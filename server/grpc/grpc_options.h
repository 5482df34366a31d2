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
  std::string address = "127.0.0.1:50051";     ///< host:port, port 0 takes a free one; or unix:PATH
  std::vector<int> sockets = {};               ///< that listen already, in its place; then the door's
  std::shared_ptr<const net::TlsContext> tls;  ///< null: in the clear
  std::size_t max_message_bytes = 64u << 20;   ///< of a request
  int num_threads = 4;                         ///< for calls that are answered quickly
  int num_bulk_threads = 0;                    ///< for meshes, voxels, many points; 0 = one a core
  bool has_nice_threads = true;                ///< what takes long leaves busy cores to others, of any process
  /// For requests and answers in memory; what goes beyond it is refused. As much again is for frames, and for gRPC's
  /// own buffers. Never null.
  std::shared_ptr<ByteBudget> inflight = std::make_shared<ByteBudget>(256u << 20);
  int max_connections = 1000;  ///< one more is closed at once
  double keepalive_s = 10;     ///< a peer is asked after so long a silence, and given up after twice that
  double import_idle_s = 30;   ///< a client that brings a map is given up so far behind 16 KiB/s
  /// There is no more room for the state that a client reads: if it takes a message within this time it is told why
  /// there is no other, else it is cut off.
  double to_take_last_s = 1;
  std::int64_t max_query_points = 1'000'000;              ///< in one QueryPoints
  int max_frames_in_flight = 4;                           ///< of a stream: read, but not yet acknowledged to the client
  MapConfig default_config;                               ///< of a new map that names no preset; valid
  std::string version;                                    ///< of the server; this and the next two for GetServerStatus
  std::string database;                                   ///< its file
  double max_behind_s = 30;                               ///< as CommitOptions has it
  std::shared_ptr<auth::Gate> gate = auth::Gate::Open();  ///< who may call; never null
  /// The servers on the same database, to which calls about maps of theirs are passed on; null: there are none.
  Fleet* fleet = nullptr;
  PeerTls peer_tls;  ///< how they are reached
};

/// What happens in the handlers, for metrics. Called from many threads; each may be empty.
struct GrpcObserver {
  std::function<void(std::string_view method, StatusCode code, double seconds)> on_call;  ///< when it has ended
  std::function<void(std::size_t num_points)> on_query;
  std::function<void(StatusCode code)> on_frame;
  /// A call was passed on to another server of the fleet: "/dhpmap.v1.MapService/GetMap", and what came of it.
  std::function<void(std::string_view path, StatusCode code)> on_relayed;
  /// A connection was refused or ended at a door: which ("grpc") and why ("too_many_resets").
  std::function<void(std::string_view door, std::string_view why)> on_refused;
};

}  // namespace dhpmap
