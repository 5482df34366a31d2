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

/// The streams that are open, and whose: so that they end with their key, and nobody has too many. Thread-safe.
class LiveStreams {
 public:
  /// Ends a stream with a status; called at most once at a time, from any thread, maybe when the stream has ended
  /// already. Must not throw.
  using End = std::function<void(const Status&)>;

  /// A stream's place, which it gives back by its end. The streams outlive it.
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

  /// RESOURCE_EXHAUSTED, reason OUT_OF_QUOTA, if the principal has as many as it may.
  Result<std::unique_ptr<Place>> Add(PrincipalPtr principal, bool is_feed, End end) DHPMAP_EXCLUDES(mutex_);

  /// Ends every stream of whose principal `check` says an error, with that error.
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
