// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "clients/cpp/calls/caller.h"
#include "dhpmap/v1/watch_service.pb.h"
#include "mapping/base/mutex.h"

namespace dhpmap::client {

/// The messages of WatchMap, across lost connections: each new connection resumes after the last position. For one
/// thread, except Close.
class MessageWatch {
 public:
  /// Called after a lost connection: false gives up.
  using GoesOn = std::function<bool(const Status& why)>;

  MessageWatch(std::shared_ptr<Caller> caller, v1::WatchMapRequest request, double reconnect_s, GoesOn goes_on);
  ~MessageWatch();
  MessageWatch(const MessageWatch&) = delete;
  MessageWatch& operator=(const MessageWatch&) = delete;

  /// The next message; nothing at `end` or after Close. An error ends the watch; Unavailable after reconnect_s without
  /// a server. After a lost connection, a revision that was received in part is received again from its beginning.
  Result<std::optional<v1::WatchMapResponse>> Next(Clock::time_point end);
  /// Ends the watch: Next returns nothing from now on, even if it is waiting. Callable from any thread.
  void Close();
  /// The position after which the watch would resume; empty: its start.
  [[nodiscard]] const std::string& position() const { return request_.resume_after(); }

 private:
  class Connection;

  /// True: the connection has another message. False: it has ended, or `end` has come.
  Result<bool> Step(Clock::time_point end, bool& has_message);
  /// Handles a lost connection. True: go on.
  Result<bool> Recover(const Status& why, Clock::time_point end);
  bool IsClosed();

  const std::shared_ptr<Caller> caller_;
  v1::WatchMapRequest request_;
  const double reconnect_s_, silence_s_;
  const GoesOn goes_on_;
  std::optional<Clock::time_point> lost_at_;
  Pauses pauses_;

  Mutex mutex_;
  bool is_closed_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::unique_ptr<Connection> connection_;  // used by the thread of Next; replaced with the mutex held
};

}  // namespace dhpmap::client
