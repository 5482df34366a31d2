// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "mapping/base/result.h"
#include "server/app/maps/map_registry.h"
#include "server/grpc/grpc_options.h"

namespace grpc {
class Channel;
}

namespace dhpmap {

/// The gRPC door: our services, grpc.health.v1 and reflection, behind server/net's limits. Thread-safe.
class GrpcServer {
 public:
  /// Binds and serves until Shutdown or destruction. Health reports NOT_SERVING until SetServing. UNAVAILABLE if the
  /// address cannot be bound. The registry outlives the server.
  static Result<std::unique_ptr<GrpcServer>> Start(const GrpcOptions& options, MapRegistry& registry,
                                                   GrpcObserver observer);
  ~GrpcServer();

  [[nodiscard]] int port() const;  ///< 0 for a unix: address
  /// Sets the answer of Health/Check and of readiness.
  void SetServing(bool is_serving);
  [[nodiscard]] bool is_serving() const;
  /// Memory of frames that are decoded, queued or fused now.
  [[nodiscard]] std::size_t frame_bytes() const;
  /// Checks of collisions and trajectories that are being answered in pieces.
  [[nodiscard]] int num_running_checks() const;
  /// Runs `work` on the lane of quick answers, after the calls that wait there. False, without keeping it, if too many
  /// wait.
  [[nodiscard]] bool PostQuick(std::function<void()> work);
  /// A channel to this server inside the process; for the REST gateway and tests.
  [[nodiscard]] std::shared_ptr<grpc::Channel> InProcessChannel();

  /// Health reports NOT_SERVING, and streams of frames end: the frames already read are fused, stored and acknowledged,
  /// then the stream ends with UNAVAILABLE. All other calls go on. Does not wait.
  void Drain();

  /// Drains, refuses new calls, gives running calls `grace_s`, cancels the rest, and aborts the frames that are being
  /// fused (MapRegistry::GiveUpMapping). Returns when all calls have ended.
  void Shutdown(double grace_s);

 private:
  struct Impl;
  explicit GrpcServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap
