// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"
#include "server/auth/call_limits.h"
#include "server/auth/keys/principal.h"

namespace dhpmap::auth {

/// The open streams of each principal: limits their number, and ends them when a key ends. Thread-safe.
class LiveStreams {
 public:
  /// Ends a stream with a status. Called from any thread, never twice at the same time, possibly after the stream has
  /// ended. Must not throw.
  using End = std::function<void(const Status&)>;

  /// Registers one stream until destruction. LiveStreams must outlive it.
  class Place {
   public:
    Place(LiveStreams& streams, std::uint64_t number) : streams_(streams), number_(number) {}
    ~Place() { streams_.Remove(number_); }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

   private:
    LiveStreams& streams_;
    const std::uint64_t number_;
  };

  explicit LiveStreams(const CallLimits& limits) : limits_(limits) {}

  /// RESOURCE_EXHAUSTED, reason OUT_OF_QUOTA, if the principal has reached its limit.
  Result<std::unique_ptr<Place>> Add(PrincipalPtr principal, bool is_feed, End end) DHPMAP_EXCLUDES(mutex_);

  /// Ends each stream for whose principal `check` returns an error, with that error.
  void EndUnless(const std::function<Status(const Principal&)>& check) DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] std::size_t size() const DHPMAP_EXCLUDES(mutex_);

 private:
  struct Stream {
    PrincipalPtr principal;
    bool is_feed;
    std::shared_ptr<const End> end;
  };
  void Remove(std::uint64_t number) DHPMAP_EXCLUDES(mutex_);

  const CallLimits limits_;
  mutable Mutex mutex_;
  std::uint64_t next_number_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::map<std::uint64_t, Stream> streams_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::auth
