// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/edit_log_conversion.h"

#include <google/protobuf/util/time_util.h>

#include <algorithm>
#include <cctype>

#include "proto/types/resource_names.h"
#include "server/base/fingerprint.h"

namespace dhpmap {
namespace {

/// 8-4-4-4-12 hexadecimal digits; any UUID version.
bool IsUuid(std::string_view text) {
  constexpr std::string_view kForm = "xxxxxxxx-xxxx-xxxx-xxxx-xxxxxxxxxxxx";
  return std::equal(text.begin(), text.end(), kForm.begin(), kForm.end(), [](char c, char form) {
    return form == '-' ? c == '-' : std::isxdigit(static_cast<unsigned char>(c)) != 0;
  });
}

v1::LoggedEdit::Kind KindOf(EditKind kind) {
  switch (kind) {
    case EditKind::kEdit: return v1::LoggedEdit::EDIT;
    case EditKind::kUndo: return v1::LoggedEdit::UNDO;
    case EditKind::kRedo: return v1::LoggedEdit::REDO;
  }
  return v1::LoggedEdit::KIND_UNSPECIFIED;
}

v1::LoggedEdit::Action ActionOf(EditAction action) {
  switch (action) {
    case EditAction::kMove: return v1::LoggedEdit::MOVE;
    case EditAction::kRelabel: return v1::LoggedEdit::RELABEL;
    case EditAction::kRename: return v1::LoggedEdit::RENAME;
    case EditAction::kClone: return v1::LoggedEdit::CLONE;
    case EditAction::kDelete: return v1::LoggedEdit::DELETE;
    case EditAction::kMerge: return v1::LoggedEdit::MERGE;
    case EditAction::kSplit: return v1::LoggedEdit::SPLIT;
    case EditAction::kClear: return v1::LoggedEdit::CLEAR;
    case EditAction::kSetPresence: return v1::LoggedEdit::SET_PRESENCE;
    case EditAction::kRenameMap: return v1::LoggedEdit::RENAME_MAP;
    case EditAction::kUndelete: return v1::LoggedEdit::UNDELETE;
    case EditAction::kLock: return v1::LoggedEdit::LOCK;
    case EditAction::kUnlock: return v1::LoggedEdit::UNLOCK;
    case EditAction::kKeepClear: return v1::LoggedEdit::IGNORE_REGION;
    case EditAction::kLift: return v1::LoggedEdit::UNIGNORE_REGION;
    case EditAction::kRestore: return v1::LoggedEdit::RESTORE;
  }
  return v1::LoggedEdit::ACTION_UNSPECIFIED;
}

}  // namespace

Result<EditSource> MakeEditSource(std::string_view method, const std::string& author, const std::string& request_id,
                                  const google::protobuf::Message& request) {
  if (author.size() > kMaxAuthorBytes) {
    return InvalidArgument("the author's name is too long")
        .WithReason("BAD_AUTHOR")
        .WithViolation("author", "is longer than " + std::to_string(kMaxAuthorBytes) + " bytes");
  }
  if (!request_id.empty() && !IsUuid(request_id)) {
    return InvalidArgument("the id of the request is not usable")
        .WithReason("BAD_REQUEST_ID")
        .WithViolation("request_id", "is no UUID: 8-4-4-4-12 hexadecimal digits");
  }
  EditSource source{.author = author, .request_id = request_id};
  std::transform(source.request_id.begin(), source.request_id.end(), source.request_id.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string text(method);
  request.AppendToString(&text);
  source.request_fingerprint = Fingerprint(text);
  return source;
}

Result<EditQuery> EditQueryFromProto(const v1::ListEditsRequest& request, const Pager& pager) {
  EditQuery query;
  if (!request.author().empty()) query.author = request.author();
  query.max_edits = pager.num_wanted();
  DHPMAP_ASSIGN_OR_RETURN(query.before_revision, RevisionFromPage(pager));
  return query;
}

namespace {

template <typename Request>
Result<UndoRequest> UndoFrom(const Request& request, EditKind kind, const std::string& map) {
  UndoRequest undo{.kind = kind, .author = request.author()};
  Status bad = InvalidArgument("the request is not usable").WithReason("BAD_EDIT");
  if (request.count() < 0 || request.count() > static_cast<int>(kMaxUndone)) {
    bad.AddViolation("count", "must be 0 (one) to " + std::to_string(kMaxUndone));
  } else if (request.count() > 0) {
    undo.count = static_cast<std::size_t>(request.count());
  }
  if (!request.edit().empty()) {
    DHPMAP_ASSIGN_OR_RETURN(const EditName name, ParseEditName(request.edit(), "edit"));
    if (name.map != map) bad.AddViolation("edit", "'" + request.edit() + "' is of another map");
    if (request.count() > 1) bad.AddViolation("count", "is of edits that are not named");
    undo.edit = name.revision;
  }
  if (!bad.violations().empty()) return bad;
  return undo;
}

}  // namespace

Result<UndoRequest> UndoFromProto(const v1::UndoEditsRequest& request, const std::string& map) {
  return UndoFrom(request, EditKind::kUndo, map);
}
Result<UndoRequest> UndoFromProto(const v1::RedoEditsRequest& request, const std::string& map) {
  return UndoFrom(request, EditKind::kRedo, map);
}

Result<RestoreRequest> RestoreFromProto(const v1::RestoreRevisionRequest& request, const std::string& map) {
  RestoreRequest restore{.revision = request.revision(),
                         .submap = std::nullopt,
                         .etag = request.etag(),
                         .expected_revision = request.expected_revision()};
  Status bad = InvalidArgument("the request is not usable").WithReason("BAD_EDIT");
  if (request.expected_revision() < 0) bad.AddViolation("expected_revision", "is negative");
  if (!request.submap().empty()) {
    DHPMAP_ASSIGN_OR_RETURN(const SubmapName name, ParseSubmapName(request.submap(), "submap"));
    if (name.map != map) bad.AddViolation("submap", "'" + request.submap() + "' is of another map");
    restore.submap = name.submap;
  }
  if (!bad.violations().empty()) return bad;
  return restore;
}

v1::LoggedEdit ToProto(const LoggedEdit& edit, const std::string& map) {
  const EditSummary& summary = edit.entry.summary;
  v1::LoggedEdit proto;
  proto.set_name(EditResourceName(map, edit.entry.revision));
  proto.set_revision(edit.entry.revision);
  *proto.mutable_create_time() = google::protobuf::util::TimeUtil::NanosecondsToTimestamp(edit.entry.time_ns);
  proto.set_author(edit.entry.source.author);
  proto.set_request_id(edit.entry.source.request_id);
  proto.set_kind(KindOf(summary.kind));
  for (const EditStep& step : summary.steps) {
    v1::LoggedEdit::Step& out = *proto.add_steps();
    out.set_action(ActionOf(step.action));
    if (step.submap != kUnknownSubmap) out.set_submap(SubmapResourceName(map, step.submap));
  }
  for (const std::int64_t target : summary.targets) proto.add_targets(EditResourceName(map, target));
  for (const SubmapId id : summary.changed) proto.add_changed_submaps(SubmapResourceName(map, id));
  for (const SubmapId id : summary.created) proto.add_created_submaps(SubmapResourceName(map, id));
  for (const SubmapId id : summary.removed) proto.add_removed_submaps(SubmapResourceName(map, id));
  proto.set_num_voxels(summary.num_voxels);
  proto.set_restored_revision(summary.restored_revision);
  proto.set_undone(edit.is_undone);
  proto.set_reversible(edit.is_kept);
  return proto;
}

}  // namespace dhpmap
