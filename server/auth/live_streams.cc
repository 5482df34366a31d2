// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/live_streams.h"

#include <utility>
#include <vector>

namespace dhpmap::auth {

Result<std::unique_ptr<LiveStreams::Place>> LiveStreams::Add(PrincipalPtr principal, bool is_feed, End end) {
  auto kept_end = std::make_shared<const End>(std::move(end));
  const MutexLock lock(mutex_);
  int num_streams = 0, num_feeds = 0;
  for (const auto& [number, stream] : streams_) {
    if (stream.principal->name != principal->name) continue;
    ++num_streams;
    num_feeds += stream.is_feed ? 1 : 0;
  }
  if (num_streams >= limits_.streams || (is_feed && num_feeds >= limits_.feeds)) {
    return ResourceExhausted("'" + principal->name + "' has as many streams open as one may")
        .WithReason("OUT_OF_QUOTA");
  }
  const std::uint64_t number = next_number_++;
  streams_.emplace(number, Stream{std::move(principal), is_feed, std::move(kept_end)});
  return std::make_unique<Place>(*this, number);
}

void LiveStreams::EndUnless(const std::function<Status(const Principal&)>& check) {
  std::vector<std::pair<std::shared_ptr<const End>, Status>> ending;
  {
    const MutexLock lock(mutex_);
    for (const auto& [number, stream] : streams_) {
      if (Status status = check(*stream.principal); !status.ok()) ending.emplace_back(stream.end, std::move(status));
    }
  }
  for (const auto& [end, why] : ending) (*end)(why);  // without the lock: a stream that ends removes itself here
}

std::size_t LiveStreams::size() const {
  const MutexLock lock(mutex_);
  return streams_.size();
}

void LiveStreams::Remove(std::uint64_t number) {
  std::shared_ptr<const End> end;  // destroyed after the lock is released
  const MutexLock lock(mutex_);
  const auto found = streams_.find(number);
  if (found == streams_.end()) return;
  end = std::move(found->second.end);
  streams_.erase(found);
}

}  // namespace dhpmap::auth
