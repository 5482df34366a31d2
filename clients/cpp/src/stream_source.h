// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "clients/cpp/src/source.h"
#include "clients/cpp/src/turn.h"

namespace dhpmap::client {

/// Sends queries on a StreamQueries one after the other. Reopens the stream after a lost connection, and pins again.
/// Thread-safe: calls wait for their turn until their deadline.
class StreamSource final : public Source {
 public:
  /// What happens when a pin expires after 10 s: queries fail, or it is renewed.
  enum class OldPin { kRefuse, kRenew };

  StreamSource(std::shared_ptr<Caller> caller, std::string map, OldPin old_pin);
  ~StreamSource() override;

  Result<v1::StreamQueriesResponse> Answer(v1::StreamQueriesRequest query, double deadline_s) override;
  std::unique_ptr<Parts<v1::QueryDistanceGridResponse>> AnswerGrid(v1::QueryDistanceGridRequest query,
                                                                   double deadline_s) override;
  /// Pins the current state (0) or a past revision; below 0: unpins. Returns the revision.
  Result<std::int64_t> Pin(std::int64_t revision);

 private:
  class Stream;

  // Called by the thread that has the turn.
  Result<v1::StreamQueriesResponse> AnswerBy(v1::StreamQueriesRequest& query, Clock::time_point end);
  Result<v1::StreamQueriesResponse> AnswerOnce(v1::StreamQueriesRequest& query, Clock::time_point end);
  /// Pins the pinned revision on a new stream.
  Status PinAgain(Clock::time_point end);

  const std::shared_ptr<Caller> caller_;
  const OldPin old_pin_;
  OneAtATime turns_;
  std::unique_ptr<Stream> stream_;
  std::atomic<std::int64_t> pinned_ = 0;  ///< written by the thread that has the turn; read by grids without it
};

}  // namespace dhpmap::client
