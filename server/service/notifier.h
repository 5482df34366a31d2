// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dhpmap::service {

/// "value" of "NAME=value" in an environment; empty if the variable is missing.
std::string ValueIn(const std::vector<std::string>& environment, std::string_view name);

/// Reports the server's state to a service manager (systemd, podman) by sd_notify(3) datagrams to the socket in
/// NOTIFY_SOCKET. Failures are ignored: the server works without its manager. Thread-safe.
class Notifier {
 public:
  /// A path, "@name" for an abstract name, or empty: no reports.
  explicit Notifier(const std::string& socket);
  ~Notifier();
  Notifier(const Notifier&) = delete;
  Notifier& operator=(const Notifier&) = delete;

  /// Whether there is a manager.
  [[nodiscard]] bool is_heard() const { return socket_ >= 0; }

  /// Progress of the start. Each report extends the manager's start timeout by ten minutes.
  void TellStarting(std::string_view status) const;
  void TellReady(std::string_view status) const;
  /// Reports that settings are being reloaded; TellReady follows.
  void TellReloading() const;
  /// Reports that the server stops; allows ten minutes for the final writes.
  void TellStopping(std::string_view status) const;
  /// Feeds the manager's watchdog.
  void TellAlive() const;

 private:
  void Send(const std::string& lines) const;

  int socket_ = -1;  ///< connected; -1: none
};

}  // namespace dhpmap::service
