// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/e2e/process.h"

namespace dhpmap::testing {

/// "127.0.0.1:12345", for a server that is to come back there after it has ended. Not one of the ports that the kernel
/// gives to whoever asks for any: another process might have it by then.
std::string AddressToComeBackTo();

/// dhpmap-server on free ports of this machine.
class ServerProcess {
 public:
  /// On DatabaseFor(db). Waits until it serves or has ended; see is_serving.
  ServerProcess(const std::filesystem::path& log_dir, const std::filesystem::path& db,
                const std::string& grpc_address = "127.0.0.1:0");

  [[nodiscard]] bool is_serving() const { return !grpc_address_.empty(); }
  [[nodiscard]] const std::string& grpc_address() const { return grpc_address_; }
  /// "http://127.0.0.1:12345".
  [[nodiscard]] const std::string& http_url() const { return http_url_; }
  /// A connection that no other channel shares, such as one to a server before on the same port.
  [[nodiscard]] std::shared_ptr<grpc::Channel> Connect() const;
  Process& process() { return process_; }
  /// SIGTERM; the exit code, or empty if it hangs.
  std::optional<int> Terminate();
  /// The client against this server.
  [[nodiscard]] Outcome Dhpmap(std::vector<std::string> arguments) const;

 private:
  std::filesystem::path log_dir_;
  Process process_;
  std::string grpc_address_, http_url_;
};

}  // namespace dhpmap::testing
