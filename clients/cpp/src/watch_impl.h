// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clients/cpp/src/caller.h"
#include "dhpmap/v1/watch_service.pb.h"
#include "dhpmap/watch.h"
#include "mapping/base/mutex.h"

namespace dhpmap::client {

/// A watch over connections that come and go. Thread-safe as Watch says: `mutex_` guards what Close touches.
struct Watch::Impl {
 public:
  Impl(std::shared_ptr<Caller> caller, const std::string& map, const WatchOptions& options);
  ~Impl();

  Result<std::optional<Change>> Next(double idle_s);
  void Close();
  [[nodiscard]] std::int64_t revision() const { return revision_; }

 private:
  class Call;

  /// Waits for the next message and takes it; true: go on. False: it is over, or `end` has come.
  Result<bool> Step(Clock::time_point end);
  void Take(const v1::WatchMapResponse& message);
  /// The connection is lost. As Step.
  Result<bool> Recover(const Status& why, Clock::time_point end);
  bool IsClosed();

  const std::shared_ptr<Caller> caller_;
  v1::WatchMapRequest request_;
  const double reconnect_s_;
  std::deque<Change> told_;
  std::vector<Change> unfinished_;  // of revisions whose last message has not come
  std::int64_t revision_ = 0;
  std::optional<Clock::time_point> lost_at_;
  Pauses pauses_;

  Mutex mutex_;
  bool is_closed_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::unique_ptr<Call> call_;  // by the thread of Next; made and dropped with the mutex held
};

}  // namespace dhpmap::client
