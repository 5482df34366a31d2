// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dhpmap::testing {

/// Serves what a test scripts, on a free port of this machine.
template <typename... Services>
class ScriptedServer {
 public:
  explicit ScriptedServer(Services&... services) : ScriptedServer(grpc::InsecureServerCredentials(), services...) {}
  explicit ScriptedServer(const std::shared_ptr<grpc::ServerCredentials>& credentials, Services&... services) {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", credentials, &port_);
    (builder.RegisterService(&services), ...);
    server_ = builder.BuildAndStart();
  }
  ~ScriptedServer() { server_->Shutdown(std::chrono::system_clock::now()); }
  ScriptedServer(const ScriptedServer&) = delete;
  ScriptedServer& operator=(const ScriptedServer&) = delete;

  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

 private:
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

}  // namespace dhpmap::testing
