// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "server/grpc/call_runner.h"

namespace dhpmap {

/// What is to be done on which map's writer thread.
struct PlannedEdit {
  std::string map;
  EditRequest request;  ///< its answer is filled in by RunEdit
};

/// Why there is no edit, or what `fill()` says of its answer. Never that nothing was changed, once it was.
inline void RespondToEdit(const Result<EditOutcome>& outcome, const Respond& respond,
                          const std::function<Status()>& fill) {
  if (!outcome.ok()) return respond(outcome.status());
  const Status filled = RunGuarded(fill);
  const bool lacks_memory = filled.code() == StatusCode::kResourceExhausted;
  respond(lacks_memory ? Internal("the edit is made; no memory to tell more") : filled);
}

/// Runs an edit without holding a thread while it waits for the writer and the disk. `plan()` gives a
/// Result<PlannedEdit>, and `fill(view, made, response)` fills the answer; a repeated request is answered as it was.
template <typename Response, typename Plan, typename Fill>
grpc::ServerUnaryReactor* RunEdit(const ServiceContext& context, const CallMessages& call, Response* response,
                                  Plan plan, Fill fill) {
  return RunAsync(context, call, [&context, response, plan, fill](const Respond& respond, const std::stop_token&) {
    Result<PlannedEdit> planned = plan();
    if (!planned.ok()) return respond(planned.status());
    const auto session = context.registry.OpenSession(planned->map);
    if (!session.ok()) return respond(session.status());
    planned->request.answer = [fill](const MapView& view, const EditMade& made) {
      Response answer;
      fill(view, made, answer);
      return answer.SerializeAsString();
    };
    (*session)->Edit(std::move(planned->request), [respond, response](const Result<EditOutcome>& outcome) {
      RespondToEdit(outcome, respond, [&]() -> Status {
        if (response->ParseFromString(outcome->answer)) return Status::Ok();
        return DataLoss("the edit is made, but what it was answered is damaged").WithReason("DAMAGED_EDITS");
      });
    });
  });
}

}  // namespace dhpmap
