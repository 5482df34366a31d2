// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/check_answer.h"

#include <optional>
#include <utility>
#include <vector>

#include "mapping/base/guarded.h"
#include "mapping/paging/page_reader.h"
#include "server/app/queries/body_check.h"
#include "server/app/queries/trajectory_check.h"
#include "server/grpc/query_answers.h"
#include "server/wire/body_conversion.h"
#include "server/wire/query_options.h"
#include "server/wire/trajectory_conversion.h"

namespace dhpmap {
namespace {

/// A small check counts as a quick call.
constexpr CheckPiece kQuickPiece{.work = 200'000, .may_overrun = false};

class CollisionAnswer final : public CheckAnswer {
 public:
  CollisionAnswer(std::shared_ptr<const MapView> view, SurfaceCache& surfaces, CheckQuestion question,
                  std::vector<Body> bodies, const v1::CheckCollisionsRequest& request,
                  v1::CheckCollisionsResponse& response)
      : view_(std::move(view)),
        bodies_(std::move(bodies)),
        check_(view_->shared_snapshot(), surfaces, std::move(question), bodies_),
        answers_(request, view_->snapshot().info(), response) {}

  Result<bool> Next(const CheckPiece& piece, const std::stop_token& stop) override {
    return check_.Next(piece, stop, [this](const BodyAnswer& answer) { answers_.Append(answer); });
  }

 private:
  const std::shared_ptr<const MapView> view_;
  const std::vector<Body> bodies_;
  BodyCheck check_;
  CollisionAnswers answers_;
};

class MotionAnswer final : public CheckAnswer {
 public:
  MotionAnswer(std::shared_ptr<const MapView> view, SurfaceCache& surfaces,
               std::shared_ptr<const CheckQuestion> question, RequestedMotions motions,
               const v1::CheckTrajectoryRequest& request, v1::CheckTrajectoryResponse& response)
      : view_(std::move(view)),
        question_(std::move(question)),
        motions_(std::move(motions)),
        check_(view_->shared_snapshot(), surfaces, *question_, motions_.size(),
               [this](std::size_t i) { return motions_[i]; }),
        answers_(request, view_->snapshot().info(), response) {}

  Result<bool> Next(const CheckPiece& piece, const std::stop_token& stop) override {
    return check_.Next(piece, stop, [this](const TrajectoryAnswer& answer) { answers_.Append(answer); });
  }

 private:
  const std::shared_ptr<const MapView> view_;
  const std::shared_ptr<const CheckQuestion> question_;  ///< owns the attached objects that the motions read
  const RequestedMotions motions_;
  TrajectoryCheck check_;
  TrajectoryAnswers answers_;
};

/// A check that moves between lanes. Owns itself: the lane holds it until it is done.
class PieceRun : public std::enable_shared_from_this<PieceRun> {
 public:
  PieceRun(const ServiceContext& context, std::unique_ptr<CheckAnswer> answer, std::shared_ptr<const MapSnapshot> state,
           std::stop_token stop, std::function<void(const Status&)> done)
      : context_(context),
        answer_(std::move(answer)),
        state_(std::move(state)),
        stop_(std::move(stop)),
        done_(std::move(done)) {
    ++context_.num_checks;
  }

  void BeginQuickly() {
    bool has_more = false;
    const Status status = Piece(kQuickPiece, has_more);
    if (!status.ok() || !has_more) return End(status);
    const auto task = std::make_shared<LaneTask>([self = shared_from_this()] { self->BeginInLane(); });
    if (context_.lanes.checks.TryPost(task)) return;
    task->GiveUp();
    End(TooBusy());
  }

  /// Pins the state while memory for it suffices.
  void BeginInLane() {
    is_in_lane_ = true;
    const Status held = Guarded<Status>([this]() -> Status {
      on_stop_.emplace(stop_, [this] { ended_.request_stop(); });
      hold_ = context_.held.TryPin(state_, [this] { ended_.request_stop(); });
      return hold_ != nullptr ? Status::Ok() : TooManyBytes();
    });
    if (!held.ok()) return End(held);
    GoOn();
  }

 private:
  void GoOn() {
    bool has_more = false;
    const Status status = Piece(CheckPiece{}, has_more);
    if (!status.ok() || !has_more) return End(status);
    const Status posted = Guarded<Status>([this] {
      context_.lanes.checks.Post([self = shared_from_this()] { self->GoOn(); });  // one task per running call
      return Status::Ok();
    });
    if (!posted.ok()) End(posted);
  }

  Status Piece(const CheckPiece& piece, bool& has_more) {
    return Guarded<Status>([&]() -> Status {
      const PageReader reading(pages_);
      DHPMAP_ASSIGN_OR_RETURN(has_more, answer_->Next(piece, is_in_lane_ ? ended_.get_token() : stop_));
      return Status::Ok();
    });
  }

  void End(Status status) {
    if (status.code() == StatusCode::kCancelled && !stop_.stop_requested()) status = StateHasNoRoom();
    hold_ = nullptr;
    on_stop_.reset();
    answer_ = nullptr;
    --context_.num_checks;
    if (!is_in_lane_) return done_(status);
    context_.lanes.answers.Post([self = shared_from_this(), status = std::move(status)] { self->done_(status); });
  }

  const ServiceContext& context_;
  std::unique_ptr<CheckAnswer> answer_;
  const std::shared_ptr<const MapSnapshot> state_;
  const std::stop_token stop_;
  const std::function<void(const Status&)> done_;
  bool is_in_lane_ = false;
  PageHold pages_;  ///< pages of the state that this check has read
  std::stop_source ended_;
  std::optional<std::stop_callback<std::function<void()>>> on_stop_;
  std::unique_ptr<PinnedSnapshots::Pin> hold_;
};

/// INVALID_ARGUMENT for a request that no state could answer.
template <typename Request>
Status CheckFits(const ServiceContext& context, const Request& request) {
  const std::size_t bytes = EffortOf(request).answer_bytes;
  return bytes <= context.options.inflight->limit_bytes() ? Status::Ok() : AnswersTooLarge(bytes);
}

}  // namespace

Result<std::unique_ptr<CheckAnswer>> CheckAnswer::Begin(const ServiceContext& context,
                                                        std::shared_ptr<const MapView> view,
                                                        const v1::CheckCollisionsRequest& request,
                                                        v1::CheckCollisionsResponse& response) {
  DHPMAP_ASSIGN_OR_RETURN(auto bodies, BodiesFromProto(request, context.options.max_query_points));
  DHPMAP_ASSIGN_OR_RETURN(auto question,
                          CheckOptionsFromProto(request.options(), LinksOf(request), view->snapshot(), kBodyOptions));
  DHPMAP_ASSIGN_OR_RETURN(question.max_contacts, MaxContactsFromProto(request));
  DHPMAP_RETURN_IF_ERROR(CheckFits(context, request));
  return std::unique_ptr<CheckAnswer>(std::make_unique<CollisionAnswer>(
      std::move(view), context.registry.surfaces(), std::move(question), std::move(bodies), request, response));
}

Result<std::unique_ptr<CheckAnswer>> CheckAnswer::Begin(const ServiceContext& context,
                                                        std::shared_ptr<const MapView> view,
                                                        const v1::CheckTrajectoryRequest& request,
                                                        v1::CheckTrajectoryResponse& response) {
  DHPMAP_ASSIGN_OR_RETURN(
      auto found, CheckOptionsFromProto(request.options(), LinksOf(request), view->snapshot(), kTrajectoryOptions));
  DHPMAP_ASSIGN_OR_RETURN(found.max_contacts, MaxContactsFromProto(request));
  found.with_clearance = request.include_clearance();
  const auto question = std::make_shared<const CheckQuestion>(std::move(found));
  DHPMAP_ASSIGN_OR_RETURN(auto motions,
                          RequestedMotions::Make(request, question->attached, context.options.max_query_points));
  DHPMAP_RETURN_IF_ERROR(CheckFits(context, request));
  return std::unique_ptr<CheckAnswer>(std::make_unique<MotionAnswer>(std::move(view), context.registry.surfaces(),
                                                                     question, std::move(motions), request, response));
}

void AnswerInPieces(const ServiceContext& context, std::unique_ptr<CheckAnswer> answer,
                    std::shared_ptr<const MapSnapshot> state, CheckBegins begins, std::stop_token stop,
                    std::function<void(const Status&)> done) {
  const auto run =
      std::make_shared<PieceRun>(context, std::move(answer), std::move(state), std::move(stop), std::move(done));
  if (begins == CheckBegins::kQuickly) run->BeginQuickly();
  else run->BeginInLane();
}

}  // namespace dhpmap
