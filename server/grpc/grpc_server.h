// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "mapping/base/byte_budget.h"
#include "mapping/base/result.h"
#include "server/app/map_registry.h"

namespace grpc {
class Channel;
}

namespace dhpmap {

struct GrpcOptions {
  std::string address = "127.0.0.1:50051";    ///< host:port; port 0 takes a free one
  std::size_t max_message_bytes = 64u << 20;  ///< of a request
  int num_threads = 4;                        ///< for calls that are answered quickly
  int num_bulk_threads = 0;                   ///< for meshes, voxels, many points; 0 = one a core
  bool has_nice_threads = true;               ///< what takes long leaves busy cores to others, of any process
  /// For requests and answers in memory; what goes beyond it is refused. As much again is for frames, and for gRPC's
  /// own buffers. Never null.
  std::shared_ptr<ByteBudget> inflight = std::make_shared<ByteBudget>(256u << 20);
  int max_connections = 1000;  ///< one more is closed at once
  double keepalive_s = 10;     ///< a peer is asked after so long a silence, and given up after twice that
  double import_idle_s = 30;   ///< a client that brings a map is given up so far behind 16 KiB/s
  /// There is no more room for the state that a client reads: if it takes a message within this time it is told why
  /// there is no other, else it is cut off.
  double to_take_last_s = 1;
  std::int64_t max_query_points = 1'000'000;  ///< in one QueryPoints
  int max_frames_in_flight = 4;               ///< of a stream: read, but not yet acknowledged to the client
  MapConfig default_config;                   ///< of a new map that names no preset; valid
};

/// What happens in the handlers, for metrics. Called from many threads; each may be empty.
struct GrpcObserver {
  std::function<void(std::string_view method, StatusCode code, double seconds)> on_call;  ///< when it has ended
  std::function<void(std::size_t num_points)> on_query;
  std::function<void(StatusCode code)> on_frame;
};

/// The gRPC door: our services, grpc.health.v1 and reflection, without TLS. Thread-safe.
class GrpcServer {
 public:
  /// Binds and serves until Shutdown or destruction; health says NOT_SERVING until SetServing. UNAVAILABLE if the
  /// address cannot be bound. The registry outlives the server.
  static Result<std::unique_ptr<GrpcServer>> Start(const GrpcOptions& options, MapRegistry& registry,
                                                   GrpcObserver observer);
  ~GrpcServer();

  [[nodiscard]] int port() const;
  /// What Health/Check and readiness say.
  void SetServing(bool is_serving);
  [[nodiscard]] bool is_serving() const;
  /// Memory of frames that are being decoded, wait to be fused, or are.
  [[nodiscard]] std::size_t frame_bytes() const;
  /// Checks of collisions and trajectories that are being answered in pieces.
  [[nodiscard]] int num_running_checks() const;
  /// A channel to this server inside the process; for the REST gateway and tests.
  [[nodiscard]] std::shared_ptr<grpc::Channel> InProcessChannel();

  /// Health says NOT_SERVING, and no more frames are taken: streams of frames end with UNAVAILABLE once what was read
  /// from them is fused, stored and acknowledged. Everything else goes on. Does not wait.
  void Drain();

  /// Drain; then refuses new calls, lets running ones go on for `grace_s`, cancels those left, gives up the frames that
  /// are being fused (MapRegistry::GiveUpMapping), and returns when all have ended.
  void Shutdown(double grace_s);

 private:
  struct Impl;
  explicit GrpcServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap
