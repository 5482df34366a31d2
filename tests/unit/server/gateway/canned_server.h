// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace dhpmap::gateway {

/// The server's answer to one method.
struct CannedAnswer {
  std::vector<std::string> messages;  ///< serialised, in answer to the first request message
  std::function<std::string(const std::string& request)> acknowledge;  ///< instead: one for each request message
  grpc::Status status;
  bool hang = false;    ///< never ends, until it is cancelled
  bool at_end = false;  ///< `messages` are in answer to the end of the requests instead
};

/// What the server received in one call.
struct HeardCall {
  std::string method;
  std::vector<std::string> requests;
  std::multimap<std::string, std::string> metadata;
  std::chrono::system_clock::time_point deadline;
};

/// An in-process gRPC server that knows every method and says what it was told to say: an empty message by default.
/// Thread-safe.
class CannedServer {
 public:
  CannedServer();
  ~CannedServer();

  std::shared_ptr<grpc::Channel> channel();
  /// `method` is its simple name: "GetMap".
  void Set(const std::string& method, CannedAnswer answer);

  /// The last call that has ended, or has begun to hang, once there were `number` of them; waits no longer than tests
  /// have patience for.
  HeardCall WaitForCall(std::size_t number = 1);
  /// True once a hanging call was cancelled; waits no longer than tests have patience for.
  bool WaitForCancel();
  std::size_t num_calls();

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::gateway
