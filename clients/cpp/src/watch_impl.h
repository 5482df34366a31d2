// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clients/cpp/calls/message_watch.h"
#include "dhpmap/watch.h"

namespace dhpmap::client {

/// Assembles the changes of whole revisions from the messages of a watch.
struct Watch::Impl {
 public:
  Impl(std::shared_ptr<Caller> caller, const std::string& map, const WatchOptions& options);

  Result<std::optional<Change>> Next(double idle_s);
  void Close() { messages_.Close(); }
  [[nodiscard]] std::int64_t revision() const { return revision_; }

 private:
  void Take(const v1::WatchMapResponse& message);

  std::deque<Change> told_;
  std::vector<Change> unfinished_;  // of revisions whose last message has not arrived
  std::int64_t revision_ = 0;
  MessageWatch messages_;
};

}  // namespace dhpmap::client
