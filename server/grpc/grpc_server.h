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

/// The gRPC door: our services, grpc.health.v1 and reflection, behind the guard of server/net. Thread-safe.
class GrpcServer {
 public:
  /// Binds and serves until Shutdown or destruction; health says NOT_SERVING until SetServing. UNAVAILABLE if the
  /// address cannot be bound. The registry outlives the server.
  static Result<std::unique_ptr<GrpcServer>> Start(const GrpcOptions& options, MapRegistry& registry,
                                                   GrpcObserver observer);
  ~GrpcServer();

  [[nodiscard]] int port() const;  ///< 0 of a unix: address
  /// What Health/Check and readiness say.
  void SetServing(bool is_serving);
  [[nodiscard]] bool is_serving() const;
  /// Memory of frames that are being decoded, wait to be fused, or are.
  [[nodiscard]] std::size_t frame_bytes() const;
  /// Checks of collisions and trajectories that are being answered in pieces.
  [[nodiscard]] int num_running_checks() const;
  /// Runs it on the lane of quick answers, behind the calls that wait there. False, without keeping it, if too many do.
  [[nodiscard]] bool PostQuick(std::function<void()> work);
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
