// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>

#include "tests/support/eventually.h"

namespace dhpmap::testing {

/// What systemd is to a service: a socket that takes what it tells (sd_notify).
class FakeManager {
 public:
  /// At a path, or under an abstract name, "@name".
  explicit FakeManager(const std::string& name) : name_(name) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::copy_n(name.begin(), std::min(name.size(), sizeof address.sun_path - 1), address.sun_path);
    if (name.front() == '@') address.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    is_open_ = ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), size) == 0;
  }
  ~FakeManager() { ::close(socket_); }
  FakeManager(const FakeManager&) = delete;
  FakeManager& operator=(const FakeManager&) = delete;

  [[nodiscard]] bool is_open() const { return is_open_; }
  [[nodiscard]] const std::string& name() const { return name_; }

  /// The next datagram; "" if none comes.
  std::string Next() {
    pollfd waiting{.fd = socket_, .events = POLLIN, .revents = 0};
    const auto patience_ms = std::chrono::milliseconds(kPatience).count();
    if (::poll(&waiting, 1, static_cast<int>(patience_ms)) != 1) return "";
    std::array<char, 4096> data{};
    const ssize_t size = ::recv(socket_, data.data(), data.size(), 0);
    return {data.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
  }
  /// The next that begins so; others are passed over. "" if none comes.
  std::string NextThatBegins(const std::string& beginning) {
    std::string told = Next();
    while (!told.empty() && !told.starts_with(beginning)) told = Next();
    return told;
  }

 private:
  const std::string name_;
  const int socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  bool is_open_ = false;
};

}  // namespace dhpmap::testing
