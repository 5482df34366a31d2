// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "clients/cpp/src/source.h"
#include "clients/cpp/src/turn.h"

namespace dhpmap::client {

/// Asks on a StreamQueries, one query after the other. Opens it anew after a lost connection, pinned as before.
/// Thread-safe: who comes second waits, until its deadline.
class StreamSource final : public Source {
 public:
  /// What becomes of a pin whose 10 s are over: the query fails, or it is renewed.
  enum class OldPin { kRefuse, kRenew };

  StreamSource(std::shared_ptr<Caller> caller, std::string map, OldPin old_pin);
  ~StreamSource() override;

  Result<v1::StreamQueriesResponse> Answer(v1::StreamQueriesRequest query, double deadline_s) override;
  std::unique_ptr<Parts<v1::QueryDistanceGridResponse>> AnswerGrid(v1::QueryDistanceGridRequest query,
                                                                   double deadline_s) override;
  /// To the present state (0) or a past revision; below 0: to none. The revision.
  Result<std::int64_t> Pin(std::int64_t revision);

 private:
  class Stream;

  // By whoever has the turn.
  Result<v1::StreamQueriesResponse> AnswerBy(v1::StreamQueriesRequest& query, Clock::time_point end);
  Result<v1::StreamQueriesResponse> AnswerOnce(v1::StreamQueriesRequest& query, Clock::time_point end);
  /// What is pinned is pinned on this stream, too.
  Status PinAgain(Clock::time_point end);

  const std::shared_ptr<Caller> caller_;
  const OldPin old_pin_;
  OneAtATime turns_;
  std::unique_ptr<Stream> stream_;
  std::atomic<std::int64_t> pinned_ = 0;  ///< written by whoever has the turn; a grid reads it without
};

}  // namespace dhpmap::client
