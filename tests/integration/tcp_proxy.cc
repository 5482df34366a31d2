// SPDX-License-Identifier: BSD-3-Clause
#include "tests/integration/tcp_proxy.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <utility>

namespace dhpmap::testing {
namespace {

constexpr int kTick_ms = 5;  // how soon it notices a freeze or the end

sockaddr_in Local(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

void Check(bool good) {
  if (!good) std::abort();
}

/// A listening socket, and its port.
int Listen(int& port) {
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address = Local(0);
  socklen_t size = sizeof address;
  Check(bind(listener, reinterpret_cast<sockaddr*>(&address), size) == 0 && listen(listener, 4) == 0);
  Check(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) == 0);
  port = ntohs(address.sin_port);
  return listener;
}

/// False if the connection has ended. Forwards at most `num_bytes`, which it decreases.
bool ForwardSome(int from, int to, std::size_t& num_bytes) {
  std::array<char, 65536> bytes{};
  const ssize_t size = recv(from, bytes.data(), std::min(bytes.size(), num_bytes), 0);
  if (size <= 0) return false;
  num_bytes -= static_cast<std::size_t>(size);
  for (ssize_t sent = 0; sent < size;) {
    const ssize_t more = send(to, bytes.data() + sent, static_cast<std::size_t>(size - sent), MSG_NOSIGNAL);
    if (more <= 0) return false;
    sent += more;
  }
  return true;
}

}  // namespace

TcpProxy::TcpProxy(int to_port) : to_port_(to_port), listener_(Listen(port_)) {
  thread_ = std::thread([this] { Run(); });
}

TcpProxy::~TcpProxy() {
  is_over_ = true;
  thread_.join();
  close(listener_);
}

void TcpProxy::Run() {
  pollfd coming{.fd = listener_, .events = POLLIN, .revents = 0};
  while (!is_over_ && poll(&coming, 1, kTick_ms) == 0) {
  }
  if (is_over_) return;
  const int client = accept(listener_, nullptr, nullptr), server = socket(AF_INET, SOCK_STREAM, 0);
  const sockaddr_in address = Local(to_port_);
  Check(client >= 0 && connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  std::array<pollfd, 2> ends{
      {{.fd = client, .events = POLLIN, .revents = 0}, {.fd = server, .events = POLLIN, .revents = 0}}};
  std::size_t num_bytes = std::numeric_limits<std::size_t>::max();
  bool is_asked = false;  // the server has sent the last bytes
  for (bool is_open = true; is_open && !is_over_ && !is_frozen_;) {
    if (poll(ends.data(), ends.size(), kTick_ms) <= 0) continue;
    if (is_frozen_) break;
    if (ends[0].revents != 0) {
      is_open = ForwardSome(client, server, num_bytes);
      if (std::exchange(is_asked, false)) ++num_answers_;
    }
    if (is_open && ends[1].revents != 0) {
      is_asked = true;
      is_open = ForwardSome(server, client, num_bytes);
    }
  }
  while (is_frozen_ && !is_over_) std::this_thread::sleep_for(std::chrono::milliseconds(kTick_ms));
  close(client);
  close(server);
}

CuttingProxy::CuttingProxy(int to_port, std::uint32_t seed)
    : to_port_(to_port), listener_(Listen(port_)), random_(seed) {
  thread_ = std::thread([this] { Run(); });
}

CuttingProxy::~CuttingProxy() {
  is_over_ = true;
  thread_.join();
  close(listener_);
}

void CuttingProxy::Run() {
  constexpr std::size_t kMostBytes = 6000;  // about ten small calls
  while (!is_over_) {
    pollfd coming{.fd = listener_, .events = POLLIN, .revents = 0};
    if (poll(&coming, 1, kTick_ms) <= 0) continue;
    const int client = accept(listener_, nullptr, nullptr), server = socket(AF_INET, SOCK_STREAM, 0);
    const sockaddr_in address = Local(to_port_);
    Check(client >= 0 && connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    Forward(client, server, random_() % kMostBytes);
    close(client);
    close(server);
  }
}

void CuttingProxy::Forward(int client, int server, std::size_t num_bytes) {
  std::array<pollfd, 2> ends{
      {{.fd = client, .events = POLLIN, .revents = 0}, {.fd = server, .events = POLLIN, .revents = 0}}};
  for (bool is_open = true; is_open && !is_over_ && num_bytes > 0;) {
    if (poll(ends.data(), ends.size(), kTick_ms) <= 0) continue;
    if (ends[0].revents != 0) is_open = ForwardSome(client, server, num_bytes);
    if (is_open && num_bytes > 0 && ends[1].revents != 0) is_open = ForwardSome(server, client, num_bytes);
  }
}

}  // namespace dhpmap::testing
