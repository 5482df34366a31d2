// SPDX-License-Identifier: BSD-3-Clause
#include "tests/e2e/server_process.h"

#include <arpa/inet.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/support/channel_arguments.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <regex>

#include "tests/e2e/test_database.h"

namespace dhpmap::testing {
namespace {

bool IsFree(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const bool is_bound = ::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  ::close(socket);
  return is_bound;
}

}  // namespace

std::string AddressToComeBackTo() {
  constexpr int kLowest = 10'000;
  int given_out = 32'768;  // from there on
  std::ifstream("/proc/sys/net/ipv4/ip_local_port_range") >> given_out;
  const int count = std::max(given_out - kLowest, 1);
  int port = kLowest + ::getpid() % count;  // tests that run at once begin to look at different ones
  for (int i = 0; i < count && !IsFree(port); ++i) port = kLowest + (port - kLowest + 1) % count;
  return "127.0.0.1:" + std::to_string(port);
}

ServerProcess::ServerProcess(const std::filesystem::path& log_dir, const std::filesystem::path& db,
                             const std::string& grpc_address)
    : log_dir_(log_dir),
      process_(log_dir,
               {Program("dhpmap-server"), "--db", DatabaseFor(db), "--grpc", grpc_address, "--http", "127.0.0.1:0"}) {
  const std::regex line("gRPC on ([0-9.:]+), REST on (http://[0-9.:]+)\n");
  const auto end = std::chrono::steady_clock::now() + kPatience;
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
  return process_.Wait();
}

Outcome ServerProcess::Dhpmap(std::vector<std::string> arguments) const {
  arguments.insert(arguments.begin(), {Program("dhpmap"), "--server", grpc_address_});
  return RunProgram(log_dir_, std::move(arguments));
}

}  // namespace dhpmap::testing
