// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "clients/cpp/calls/frame_stream.h"
#include "dhpmap/feed.h"

namespace dhpmap::client {

/// Checks and numbers frames. For one thread.
struct Feed::Impl {
  /// Waits for the server's first message.
  static Result<std::unique_ptr<Impl>> Open(const std::shared_ptr<Caller>& caller, const std::string& map,
                                            const FeedOptions& options);

  Result<std::int64_t> Push(Result<v1::Frame> frame, std::int64_t stamp_ns);

  FeedOptions options;
  std::unique_ptr<FrameStream> stream;
  std::int64_t next = 1;
  std::optional<std::int64_t> last_stamp_ns;
};

}  // namespace dhpmap::client
