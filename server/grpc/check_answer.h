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

/// Answers a CheckCollisions or CheckTrajectory from one state of a map, piece by piece. Thread-compatible.
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

  /// Writes some more of the response; true if more is to come. Errors as of BodyCheck::Next.
  virtual Result<bool> Next(const CheckPiece& piece, const std::stop_token& stop) = 0;
};

/// Where a check begins that has the lane's thread.
enum class CheckBegins {
  kQuickly,  ///< what takes no longer than a quick call may is answered here; the rest goes to the lane of checks
  kInLane    ///< it has that lane's thread
};

/// Answers a check in pieces, each in its turn on the lane of checks, and says done() when all of it is written, or
/// why not: what Next says, RESOURCE_EXHAUSTED where too many wait or there is no room for the state that it is
/// answered from, CANCELLED soon after `stop` is requested. `done` may run before it returns, and on the lane of
/// answers.
void AnswerInPieces(const ServiceContext& context, std::unique_ptr<CheckAnswer> answer,
                    std::shared_ptr<const MapSnapshot> state, CheckBegins begins, std::stop_token stop,
                    std::function<void(const Status&)> done);

}  // namespace dhpmap
