// SPDX-License-Identifier: BSD-3-Clause
#include "tests/e2e/server_process.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/support/channel_arguments.h>

#include <chrono>
#include <csignal>
#include <regex>

namespace dhpmap::testing {
namespace {

constexpr double kStartTimeout_s = 60;
constexpr double kEndTimeout_s = 10;

}  // namespace

ServerProcess::ServerProcess(const std::filesystem::path& log_dir, const std::filesystem::path& db,
                             const std::string& grpc_address)
    : log_dir_(log_dir),
      process_(log_dir,
               {Program("dhpmap-server"), "--db", db.string(), "--grpc", grpc_address, "--http", "127.0.0.1:0"}) {
  const std::regex line("gRPC on ([0-9.:]+), REST on (http://[0-9.:]+)\n");
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(kStartTimeout_s);
  while (std::chrono::steady_clock::now() < end) {
    const bool has_ended = process_.Wait(0.02).has_value();
    const std::string text = process_.Stdout();
    std::smatch match;
    if (std::regex_search(text, match, line)) {
      grpc_address_ = match[1];
      http_url_ = match[2];
      return;
    }
    if (has_ended) return;
  }
}

std::shared_ptr<grpc::Channel> ServerProcess::Connect() const {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(grpc_address_, grpc::InsecureChannelCredentials(), arguments);
}

std::optional<int> ServerProcess::Terminate() {
  process_.Signal(SIGTERM);
  return process_.Wait(kEndTimeout_s);
}

Outcome ServerProcess::Dhpmap(std::vector<std::string> arguments) const {
  arguments.insert(arguments.begin(), {Program("dhpmap"), "--server", grpc_address_});
  return RunProgram(log_dir_, std::move(arguments));
}

}  // namespace dhpmap::testing
