// SPDX-License-Identifier: BSD-3-Clause
// The part of a session that edits its map.
#include <string>
#include <utility>

#include "mapping/base/guarded.h"
#include "server/app/map_session.h"

namespace dhpmap {
namespace {

/// What an edit is answered that did not happen because it could not be stored.
Status NotMade(const Status& cause) {
  return Status(cause.code(), "nothing was changed, because it cannot be stored: " + cause.message())
      .WithReason(cause.reason().empty() ? Reason("NOT_STORED") : cause.reason());
}

}  // namespace

void MapSession::Edit(EditRequest request, std::function<void(Result<EditOutcome>)> done) {
  auto run = [this, request = std::move(request), done] {
    done(Guarded<Result<EditOutcome>>([&] { return EditNow(request); }));
    // Nobody waits for it. Frames that are fused already keep their time: they may not be in this state.
    if (!commits_.lacks_left()) return;
    shown_->ShowNewest();  // which may be that of frames
    commits_.Request(builder_.map().published(), Durability::kNormal);
  };
  Post({.run = std::move(run),
        .refuse = [done = std::move(done)](const Status& status) { done(CopyOf(status)); },
        .is_edit = true});
}

void MapSession::Edit(std::function<Result<SubmapId>(Map&)> change, std::function<void(Result<EditOutcome>)> done,
                      EditMode mode) {
  auto make = [change = std::move(change)](Map& map) -> Result<EditMade> {
    DHPMAP_ASSIGN_OR_RETURN(const SubmapId submap, change(map));
    return EditMade{.submap = submap, .summary = {}};
  };
  Edit(EditRequest{.change = std::move(make), .mode = mode}, std::move(done));
}

/// If it fails or throws, the map is as it was.
Result<EditOutcome> MapSession::EditNow(const EditRequest& request) {
  const bool is_tried = request.mode == EditMode::kTryOnly;
  if (!is_tried && !request.source.request_id.empty()) {  // before all else: an etag would be the old one
    DHPMAP_ASSIGN_OR_RETURN(auto repeated, FindRepeated(request.source));
    if (repeated) return *std::move(repeated);
  }
  // First what is fused: revisions and etags of what the change meets are then those of its present state, and what is
  // dropped if the store fails is the change alone.
  Publish();
  const auto before = builder_.map().published();
  if (const Status stored = CommitPublished(); !stored.ok()) return NotMade(stored);
  Map& map = builder_.map();
  Map unchanged(before);  // now: to go back must not fail
  auto outcome = Guarded<Result<EditOutcome>>([&]() -> Result<EditOutcome> {
    DHPMAP_ASSIGN_OR_RETURN(const EditMade made, request.change(map));
    if (!is_tried) return StoreEdit(request, made, before);
    EditOutcome tried{View(), made.submap};
    if (request.answer) tried.answer = request.answer(MapView(map.Publish(options_.now_ns()), tried.view.get()), made);
    return tried;
  });
  if (!outcome.ok() || is_tried) map = std::move(unchanged);  // it may have stopped half-way
  return outcome;
}

Result<std::optional<EditOutcome>> MapSession::FindRepeated(const EditSource& source) const {
  DHPMAP_ASSIGN_OR_RETURN(auto stored, store_.FindAnswer(builder_.map().info().name, source.request_id));
  if (!stored) return std::optional<EditOutcome>();
  if (stored->request_fingerprint != source.request_fingerprint) {
    return InvalidArgument("the request has the id of another one, which made revision " +
                           std::to_string(stored->revision))
        .WithReason("REQUEST_ID_REUSED")
        .WithMetadata("revision", std::to_string(stored->revision));
  }
  return std::optional(EditOutcome{View(), SubmapId(), std::move(stored->answer)});
}

/// If it fails or throws, the edit is not stored; what it made of the map must be dropped.
Result<EditOutcome> MapSession::StoreEdit(const EditRequest& request, const EditMade& made,
                                          const std::shared_ptr<const MapSnapshot>& before) {
  Map& map = builder_.map();
  const std::int64_t now_ns = options_.now_ns();
  // Even if nothing changes, it is in the log.
  if (!request.source.request_id.empty() && !map.is_changed()) (void)map.mutable_info();
  const auto view = std::make_shared<const MapView>(map.Publish(now_ns), View().get());
  EditOutcome outcome{view, made.submap, request.answer ? request.answer(*view, made) : std::string()};
  std::shared_ptr<EditRecord> record;
  if (view->snapshot().revision() != before->revision()) {
    record = std::make_shared<EditRecord>();
    record->entry = {view->snapshot().revision(), now_ns, request.source, made.summary};
    if (!request.source.request_id.empty()) record->answer = outcome.answer;
    record->before = before;
    record->cleared = made.cleared;
  }
  if (const Status stored = commits_.CommitUnseen(view->shared_snapshot(), record); !stored.ok()) {
    return NotMade(stored);
  }
  // It is stored: nothing may throw from here on.
  if (record != nullptr && recorder_ && *recorder_)
    TellSafely([&] { (*recorder_)->OnEdited(view->snapshot().revision(), request.arrived); });
  shown_->Show(view);
  outcome.view = view;
  return outcome;
}

}  // namespace dhpmap
