// SPDX-License-Identifier: BSD-3-Clause
#include "server/service/notifier.h"

#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>

namespace dhpmap::service {
namespace {

constexpr char kMoreTime[] = "\nEXTEND_TIMEOUT_USEC=600000000";
/// Limit of waiting for a manager that does not read.
constexpr timeval kLongestSend{.tv_sec = 5, .tv_usec = 0};

/// A status must be one line, because a datagram may hold several assignments.
std::string StatusLine(std::string_view status) {
  std::string line = "STATUS=" + std::string(status);
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

int Connect(const std::string& name) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (name.empty() || name.size() >= sizeof address.sun_path) return -1;
  std::copy(name.begin(), name.end(), address.sun_path);
  if (name.front() == '@') address.sun_path[0] = '\0';
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  const int socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return -1;
  (void)::setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &kLongestSend, sizeof kLongestSend);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), size) == 0) return socket;
  ::close(socket);
  return -1;
}

}  // namespace

std::string ValueIn(const std::vector<std::string>& environment, std::string_view name) {
  for (const std::string& variable : environment) {
    if (variable.size() > name.size() && variable.starts_with(name) && variable[name.size()] == '=') {
      return variable.substr(name.size() + 1);
    }
  }
  return "";
}

Notifier::Notifier(const std::string& socket) : socket_(Connect(socket)) {}

Notifier::~Notifier() {
  if (socket_ >= 0) ::close(socket_);
}

void Notifier::TellStarting(std::string_view status) const { Send(StatusLine(status) + kMoreTime); }

void Notifier::TellReady(std::string_view status) const { Send("READY=1\n" + StatusLine(status)); }

void Notifier::TellReloading() const {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  const auto now_us = std::chrono::duration_cast<std::chrono::microseconds>(now).count();
  Send("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(now_us) + "\nSTATUS=reading settings again");
}

void Notifier::TellStopping(std::string_view status) const { Send("STOPPING=1\n" + StatusLine(status) + kMoreTime); }

void Notifier::TellAlive() const { Send("WATCHDOG=1"); }

void Notifier::Send(const std::string& lines) const {
  if (socket_ >= 0) (void)::send(socket_, lines.data(), lines.size(), MSG_NOSIGNAL);
}

}  // namespace dhpmap::service
