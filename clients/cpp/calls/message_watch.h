// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "clients/cpp/calls/caller.h"
#include "dhpmap/v1/watch_service.pb.h"
#include "mapping/base/mutex.h"

namespace dhpmap::client {

/// What WatchMap tells, over connections that come and go: each goes on after the last position. For one thread, but
/// Close.
class MessageWatch {
 public:
  /// Asked whenever a connection is lost: false gives up.
  using GoesOn = std::function<bool(const Status& why)>;

  MessageWatch(std::shared_ptr<Caller> caller, v1::WatchMapRequest request, double reconnect_s, GoesOn goes_on);
  ~MessageWatch();
  MessageWatch(const MessageWatch&) = delete;
  MessageWatch& operator=(const MessageWatch&) = delete;

  /// The next message; nothing once `end` has come, or after Close. What has ended the watch; Unavailable after
  /// reconnect_s without a server. After a lost connection a revision that was told in part is told from its beginning.
  Result<std::optional<v1::WatchMapResponse>> Next(Clock::time_point end);
  /// Ends it: Next, also one that waits, returns nothing from now on. Safe from any thread.
  void Close();
  /// Where the watch would go on now; empty: where it began.
  [[nodiscard]] const std::string& position() const { return request_.resume_after(); }

 private:
  class Connection;

  /// True: there is another message, in the connection. False: it is over, or `end` has come.
  Result<bool> Step(Clock::time_point end, bool& has_message);
  /// The connection is lost. True: go on.
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
  std::unique_ptr<Connection> connection_;  // by the thread of Next; made and dropped with the mutex held
};

}  // namespace dhpmap::client
