// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <stop_token>

#include "dhpmap/v1/query_service.pb.h"
#include "server/app/queries/check_piece.h"
#include "server/app/states/map_view.h"
#include "server/grpc/call_runner.h"

namespace dhpmap {

/// Answers a CheckCollisions or CheckTrajectory from one state of a map, in pieces. Thread-compatible.
class CheckAnswer {
 public:
  // Both messages outlive it.
  static Result<std::unique_ptr<CheckAnswer>> Begin(const ServiceContext& context, std::shared_ptr<const MapView> view,
                                                    const v1::CheckCollisionsRequest& request,
                                                    v1::CheckCollisionsResponse& response);
  static Result<std::unique_ptr<CheckAnswer>> Begin(const ServiceContext& context, std::shared_ptr<const MapView> view,
                                                    const v1::CheckTrajectoryRequest& request,
                                                    v1::CheckTrajectoryResponse& response);
  virtual ~CheckAnswer() = default;

  /// Writes one more piece of the response; true if there is more to write. Errors as of BodyCheck::Next.
  virtual Result<bool> Next(const CheckPiece& piece, const std::stop_token& stop) = 0;
};

/// Where the caller of AnswerInPieces runs.
enum class CheckBegins {
  kQuickly,  ///< on a quick lane: answers there what a quick call may take, and moves the rest to the lane of checks
  kInLane    ///< on the lane of checks
};

/// Answers a check in pieces, which take turns on the lane of checks. Calls done() when the answer is complete, or with
/// an error: one of Next; RESOURCE_EXHAUSTED if too many checks wait or the state does not fit into memory; CANCELLED
/// soon after `stop` is requested. `done` may run before AnswerInPieces returns, and on the lane of answers.
void AnswerInPieces(const ServiceContext& context, std::unique_ptr<CheckAnswer> answer,
                    std::shared_ptr<const MapSnapshot> state, CheckBegins begins, std::stop_token stop,
                    std::function<void(const Status&)> done);

}  // namespace dhpmap
