// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "server/grpc/call_runner.h"
#include "server/wire/edit_log_conversion.h"

namespace dhpmap {

/// An edit, and the map whose writer runs it.
struct PlannedEdit {
  std::string map;
  EditRequest request;  ///< RunEdit fills in its answer
};

/// The change as an edit, with the fields that all edit requests share: author, id, and whether it is a trial.
/// INVALID_ARGUMENT for a negative expected_revision.
template <typename Request>
Result<PlannedEdit> PlanEdit(std::string_view method, const Request& request, std::string map,
                             std::function<Result<EditMade>(Map&)> change) {
  if (request.expected_revision() < 0) {
    return InvalidArgument("the request is not usable")
        .WithReason("BAD_EDIT")
        .WithViolation("expected_revision", "is negative");
  }
  DHPMAP_ASSIGN_OR_RETURN(EditSource source, EditSourceOf(method, request));
  const EditMode mode = request.validate_only() ? EditMode::kTryOnly : EditMode::kMake;
  return PlannedEdit{std::move(map), {.change = std::move(change), .source = std::move(source), .mode = mode}};
}

/// The answer to a trial. It names the revision that the trial met, but no etag and no revision of a result, since no
/// result is stored.
template <typename Response>
void SayTried(std::int64_t revision, Response& response) {
  response.set_revision(revision);
  if constexpr (requires { response.mutable_map()->set_revision(revision); }) {
    response.mutable_map()->set_revision(revision);
  }
  if constexpr (requires { response.mutable_submap(); }) {
    if (!response.has_submap() || response.submap().revision() <= revision) return;
    response.mutable_submap()->clear_revision();
    response.mutable_submap()->clear_etag();
  }
}

/// Responds with the error, or with the status of `fill()`. An edit that was made is never reported as unmade.
inline void RespondToEdit(const Result<EditOutcome>& outcome, const Respond& respond,
                          const std::function<Status()>& fill) {
  if (!outcome.ok()) return respond(outcome.status());
  const Status filled = RunGuarded(fill);
  const bool lacks_memory = filled.code() == StatusCode::kResourceExhausted;
  respond(lacks_memory ? Internal("the edit is made; no memory to tell more") : filled);
}

/// Runs an edit without holding a thread while it waits for the writer and the disk. `plan()` returns a
/// Result<PlannedEdit>; `fill(view, made, response)` fills the answer. A repeated request gets its first answer again.
template <typename Response, typename Plan, typename Fill>
grpc::ServerUnaryReactor* RunEdit(const ServiceContext& context, const CallMessages& call, Response* response,
                                  Plan plan, Fill fill) {
  const CallMessages kept = call;
  return RunAsync(
      context, call, [&context, kept, response, plan, fill](const Respond& respond, const std::stop_token&) {
        Result<PlannedEdit> planned = plan();
        if (!planned.ok()) return respond(planned.status());
        const auto open_map = context.registry.GetOpen(planned->map);
        if (!open_map.ok()) return respond(open_map.status());
        planned->request.answer = [fill](const MapView& view, const EditMade& made) {
          Response answer;
          fill(view, made, answer);
          return answer.SerializeAsString();
        };
        if ((*open_map)->IsRecorded()) {
          planned->request.arrived = {std::string(kept.method), kept.request->SerializeAsString()};
        }
        const bool is_tried = planned->request.mode == EditMode::kTryOnly;
        (*open_map)->Edit(
            std::move(planned->request), [respond, response, is_tried](const Result<EditOutcome>& outcome) {
              RespondToEdit(outcome, respond, [&]() -> Status {
                if (!response->ParseFromString(outcome->answer)) {
                  return DataLoss("the edit is made, but what it was answered is damaged").WithReason("DAMAGED_EDITS");
                }
                if (is_tried) SayTried(outcome->view->snapshot().revision(), *response);
                return Status::Ok();
              });
            });
      });
}

}  // namespace dhpmap
