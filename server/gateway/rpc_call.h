// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/gateway/rpc_status.h"

namespace grpc {
class Channel;
}

namespace dhpmap::gateway {

struct CallOptions {
  std::string rpc_path;                                       ///< "/dhpmap.v1.MapService/GetMap"
  std::vector<std::pair<std::string, std::string>> metadata;  ///< lower-case keys, printable ASCII values
  std::optional<std::chrono::nanoseconds> timeout;
  std::shared_ptr<const void> kept;  ///< kept alive until the call ends
};

/// A running unary RPC.
class UnaryCall {
 public:
  virtual ~UnaryCall() = default;
  /// Makes the call end soon with CANCELLED, if it is still running. Thread-safe.
  virtual void Cancel() = 0;
};

/// Receives the events of a streaming RPC on gRPC's threads: one OnMessage or OnReadEnd for each Read, one OnSent for
/// each Send, and finally one OnDone.
class StreamListener {
 public:
  virtual ~StreamListener() = default;
  virtual void OnMessage(std::string message) = 0;
  virtual void OnReadEnd() = 0;
  virtual void OnSent(bool ok) = 0;
  virtual void OnDone(RpcStatus status) = 0;
};

/// A running streaming RPC, in either or both directions. At most one Read and one Send may be pending. The call cannot
/// end before OnReadEnd and Finish: keep reading, also after Cancel. Not thread-safe, except Cancel.
class StreamCall {
 public:
  virtual ~StreamCall() = default;
  virtual void Read() = 0;
  virtual void Send(std::string message) = 0;
  /// Half-closes; once only, when no Send is pending.
  virtual void SendEnd() = 0;
  /// Promises that only Cancel follows; OnDone comes after it.
  virtual void Finish() = 0;
  virtual void Cancel() = 0;
};

/// Starts RPCs by name on a channel. Thread-safe; outlives its calls, see WaitUntilIdle.
class RpcCaller {
 public:
  explicit RpcCaller(std::shared_ptr<grpc::Channel> channel);
  ~RpcCaller();

  /// `done` runs once, on a gRPC thread.
  std::shared_ptr<UnaryCall> StartUnary(const CallOptions& options, std::string request,
                                        std::function<void(RpcStatus, std::string response)> done);
  /// The listener is kept until OnDone has returned.
  std::shared_ptr<StreamCall> StartStream(const CallOptions& options, std::shared_ptr<StreamListener> listener);

  /// Waits until no RPC is running, at most `timeout`. False if some still are.
  bool WaitUntilIdle(std::chrono::milliseconds timeout);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::gateway
