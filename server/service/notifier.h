// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dhpmap::service {

/// "value" of "NAME=value" in an environment; empty if there is none.
std::string ValueIn(const std::vector<std::string>& environment, std::string_view name);

/// Tells a service manager (systemd, podman) how the server fares: the datagrams of sd_notify(3), to the socket that
/// NOTIFY_SOCKET names. What cannot be told is not: a server goes on without its manager. Thread-safe.
class Notifier {
 public:
  /// A path, "@name" for one of the abstract names, or empty: nobody is told.
  explicit Notifier(const std::string& socket);
  ~Notifier();
  Notifier(const Notifier&) = delete;
  Notifier& operator=(const Notifier&) = delete;

  /// Whether there is a manager to be told.
  [[nodiscard]] bool is_heard() const { return socket_ >= 0; }

  /// How far the start is. Each asks for ten minutes until the next, in place of what the manager gives to a start.
  void TellStarting(std::string_view status) const;
  void TellReady(std::string_view status) const;
  /// Settings are being read again; then TellReady.
  void TellReloading() const;
  /// The same ten minutes, for what is stored at the end.
  void TellStopping(std::string_view status) const;
  /// For the manager's watchdog.
  void TellAlive() const;

 private:
  void Send(const std::string& lines) const;

  int socket_ = -1;  ///< connected; -1: none
};

}  // namespace dhpmap::service
