// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/map_editor.h"

#include <string>
#include <utility>

#include "mapping/base/guarded.h"

namespace dhpmap {
namespace {

/// The error for an edit that was not made because it could not be stored.
Status NotMade(const Status& cause) {
  Status status(cause.code(), "nothing was changed, because it cannot be stored: " + cause.message());
  for (const auto& [key, value] : cause.metadata()) status = std::move(status).WithMetadata(key, value);
  return std::move(status).WithReason(cause.reason().empty() ? Reason("NOT_STORED") : cause.reason());
}

/// The log entry of an edit.
std::shared_ptr<EditRecord> RecordOf(const EditRequest& request, const EditMade& made, const EditOutcome& outcome,
                                     std::int64_t now_ns, std::shared_ptr<const MapSnapshot> before) {
  auto record = std::make_shared<EditRecord>();
  record->entry = {outcome.view->snapshot().revision(), now_ns, request.source, made.summary};
  if (!request.source.request_id.empty()) record->answer = outcome.answer;
  record->before = std::move(before);
  record->cleared = made.cleared;
  return record;
}

}  // namespace

void MapEditor::Edit(EditRequest request, std::function<void(Result<EditOutcome>)> done) {
  auto run = [this, request = std::move(request), done] {
    done(Guarded<Result<EditOutcome>>([&] { return EditNow(request); }));
    if (!writer_.committer.lacks_left()) return;
    writer_.publisher.shown().ShowNewest();  // the newest state may contain frames
    writer_.committer.StoreLeft(writer_.map().published());
  };
  writer_.queue.Post({.run = std::move(run),
                      .refuse = [done = std::move(done)](const Status& status) { done(CopyOf(status)); },
                      .is_edit = true});
}

/// On a failure or exception the map is unchanged.
Result<EditOutcome> MapEditor::EditNow(const EditRequest& request) {
  const bool is_tried = request.mode == EditMode::kTryOnly;
  if (!is_tried && !request.source.request_id.empty()) {  // first: its preconditions no longer hold
    DHPMAP_ASSIGN_OR_RETURN(auto repeated, FindRepeated(request.source));
    if (repeated) return *std::move(repeated);
  }
  // Publish the fused frames first. Then revisions and etags refer to the state that the edit changes, and only the
  // edit is dropped if the store fails.
  writer_.publisher.Publish();
  Map& map = writer_.map();
  const auto before = map.published();
  if (const Status stored = writer_.committer.StoreFirst(before); !stored.ok()) return NotMade(stored);
  Map unchanged(before);  // now, because restoring it must not fail
  auto outcome = Guarded<Result<EditOutcome>>([&]() -> Result<EditOutcome> {
    DHPMAP_ASSIGN_OR_RETURN(const EditMade made, request.change(map));
    if (!is_tried) return Store(request, made, before);
    EditOutcome tried{writer_.publisher.Visible(), made.submap};
    if (request.answer) tried.answer = request.answer(MapView(map.Publish(writer_.now_ns()), tried.view.get()), made);
    return tried;
  });
  if (!outcome.ok() || is_tried) map = std::move(unchanged);  // the edit may be incomplete
  return outcome;
}

Result<std::optional<EditOutcome>> MapEditor::FindRepeated(const EditSource& source) const {
  DHPMAP_ASSIGN_OR_RETURN(auto stored, store_.FindAnswer(writer_.map().info().name, source.request_id));
  if (!stored) return std::optional<EditOutcome>();
  if (stored->request_fingerprint != source.request_fingerprint) {
    return InvalidArgument("the request has the id of another one, which made revision " +
                           std::to_string(stored->revision))
        .WithReason("REQUEST_ID_REUSED")
        .WithMetadata("revision", std::to_string(stored->revision));
  }
  return std::optional(EditOutcome{writer_.publisher.Visible(), SubmapId(), std::move(stored->answer)});
}

/// On a failure or exception the edit is not stored, and the caller must drop its changes.
Result<EditOutcome> MapEditor::Store(const EditRequest& request, const EditMade& made, const State& before) {
  Map& map = writer_.map();
  const std::int64_t now_ns = writer_.now_ns();
  // Edits without effect are logged, too.
  if (!request.source.request_id.empty() && !map.is_changed()) (void)map.mutable_info();
  const auto view = std::make_shared<const MapView>(map.Publish(now_ns), writer_.publisher.Visible().get());
  EditOutcome outcome{view, made.submap, request.answer ? request.answer(*view, made) : std::string()};
  const bool is_logged = view->snapshot().revision() != before->revision();
  auto record = is_logged ? RecordOf(request, made, outcome, now_ns, before) : nullptr;
  if (const Status stored = writer_.committer.StoreUnseen(view->shared_snapshot(), std::move(record)); !stored.ok()) {
    return NotMade(stored);
  }
  // The edit is stored: nothing may throw from here on.
  if (is_logged) {
    writer_.recording.Note(
        [&](FrameRecorder& recorder) { recorder.OnEdited(view->snapshot().revision(), request.arrived); });
  }
  writer_.publisher.shown().Show(view);
  return outcome;
}

}  // namespace dhpmap
