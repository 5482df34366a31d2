// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/clients/list_editing_client.h"

#include <cstdlib>

namespace dhpmap::rig {
namespace {

constexpr std::size_t kMaxMade = 30;
constexpr int kMostCopies = 12, kMostChanged = 3;

/// Far above the corridor, where no camera looks.
constexpr int kLowestList_mm = 50'000, kHighestList_mm = 90'000;

/// A history that another map has had goes with its map.
bool IsOf(const std::string& edit, const FedMap& map) { return edit.starts_with(map.name + "/"); }

std::optional<std::int64_t> IdOf(const std::string& submap) {
  const auto slash = submap.rfind('/');
  if (slash == std::string::npos) return std::nullopt;
  return std::strtoll(submap.c_str() + slash + 1, nullptr, 10);
}

}  // namespace

void ListEditingClient::Run(const Life& life) {
  Connection server(life, ledger_);
  bool goes_on = true;
  while (goes_on) goes_on = WorkOn(AnyOf(life.maps), server);
}

bool ListEditingClient::WorkOn(const FedMap& map, Connection& server) {
  v1::ListSubmapsResponse all;
  if (!Look(map, server, all)) return false;
  if (!map.is_edited) return true;
  return Happens(40) ? TakeBack(map, server) : ApplyList(map, all, server);
}

bool ListEditingClient::Look(const FedMap& map, Connection& server, v1::ListSubmapsResponse& all) {
  const Moment asked = ledger_.Now();
  if (server.List(map.name, all).fate != Fate::kAnswered) return false;
  ledger_.OnListing(map.history, all, asked);
  return true;
}

v1::Pose ListEditingClient::SomewhereAbove() {
  v1::Pose pose;
  pose.mutable_translation_m()->set_x(Any(3000) * 1e-3);
  pose.mutable_translation_m()->set_z((kLowestList_mm + Any(kHighestList_mm - kLowestList_mm)) * 1e-3);
  return pose;
}

bool ListEditingClient::ApplyList(const FedMap& map, const v1::ListSubmapsResponse& all, Connection& server) {
  std::vector<const v1::Submap*> held, things;
  for (const v1::Submap& submap : all.submaps()) {
    if (ledger_.IsHeld(map.history, submap.instance_id())) held.push_back(&submap);
    if (submap.kind() == v1::LabelClass::THING && submap.instance_id() != 0) things.push_back(&submap);
  }
  Draft draft{.history = map.history};
  draft.request.set_map(map.name);
  draft.request.set_author(author_);
  if (!things.empty() && (held.empty() || (held.size() < kMostCopies && Happens(50)))) Copy(*AnyOf(things), draft);
  for (int i = Any(kMostChanged + 1); i > 0 && !held.empty(); --i) {
    const auto chosen = held.begin() + Any(static_cast<int>(held.size()));
    Change(**chosen, draft);
    held.erase(chosen);
  }
  if (draft.edits.empty()) return true;
  const auto ids = ledger_.BeginList(draft.edits);
  if (!ids) return true;
  v1::ApplyEditsResponse response;
  const Outcome outcome = server.Ask(
      "ApplyEdits", {"SUBMAP_NOT_FOUND", "MERGED_INTO", "ETAG_MISMATCH"},
      [&](grpc::ClientContext* context) { return server.edits->ApplyEdits(context, draft.request, &response); });
  return SettleList(map, draft, *ids, outcome, response);
}

/// One of a list's changes of an object that is held: it goes, or has another name, and perhaps place and class.
void ListEditingClient::Change(const v1::Submap& submap, Draft& draft) {
  SubmapEdit edit{
      .plan = {.what = "ApplyEdits on " + submap.name(), .history = draft.history, .id = submap.instance_id()}};
  const bool with_etag = Happens(40);
  if (with_etag) edit.etag = StateOf(draft.history, submap);
  if (Happens(20)) {
    v1::Edit& step = *draft.request.add_edits();
    step.set_submap(submap.name());
    step.mutable_delete_();
    if (with_etag) step.set_etag(submap.etag());
    edit.plan.change.presence = Presence::kGone;
    draft.edits.push_back(std::move(edit));
    draft.clones.push_back(-1);
    return;
  }
  Rename(submap, std::move(edit), draft);
}

void ListEditingClient::Rename(const v1::Submap& submap, SubmapEdit edit, Draft& draft) {
  const auto add_step = [&]() -> v1::Edit& {
    v1::Edit& step = *draft.request.add_edits();
    step.set_submap(submap.name());
    if (edit.etag) step.set_etag(submap.etag());
    return step;
  };
  edit.plan.change.display_name = NewName();
  add_step().mutable_rename()->set_display_name(*edit.plan.change.display_name);
  if (Happens(50)) {
    const v1::Pose pose = SomewhereAbove();
    *add_step().mutable_move()->mutable_map_from_submap() = pose;
    edit.plan.change.position_m = Eigen::Vector3d(pose.translation_m().x(), 0, pose.translation_m().z());
  }
  if (submap.kind() == v1::LabelClass::THING && Happens(30)) {
    edit.plan.change.class_id = 1 + Any(kNumThingClasses);
    add_step().mutable_relabel()->set_class_id(*edit.plan.change.class_id);
  }
  draft.edits.push_back(std::move(edit));
  draft.clones.push_back(-1);
}

/// The copy is named at once, or by a later edit of the list.
void ListEditingClient::Copy(const v1::Submap& original, Draft& draft) {
  const int place = draft.request.edits_size();
  const v1::Pose pose = SomewhereAbove();
  const std::string name = NewName();
  v1::Edit& step = *draft.request.add_edits();
  step.set_submap(original.name());
  *step.mutable_clone()->mutable_map_from_submap() = pose;
  if (Happens(50)) {
    step.mutable_clone()->set_display_name(name);
  } else {
    v1::Edit& naming = *draft.request.add_edits();
    naming.set_submap("#" + std::to_string(place));
    naming.mutable_rename()->set_display_name(name);
  }
  draft.edits.push_back(
      {.plan = {.what = "ApplyEdits with a copy of " + original.name(),
                .history = draft.history,
                .change = {.presence = Presence::kThere,
                           .display_name = name,
                           .position_m = Eigen::Vector3d(pose.translation_m().x(), 0, pose.translation_m().z())},
                .before = {.presence = Presence::kGone}}});
  draft.clones.push_back(place);
}

bool ListEditingClient::SettleList(const FedMap& map, const Draft& draft, const std::vector<EditId>& ids,
                                   const Outcome& outcome, const v1::ApplyEditsResponse& response) {
  if (outcome.fate == Fate::kRefused) ledger_.OnListRefused(ids);
  if (outcome.fate == Fate::kCut) ledger_.OnListCut(ids);
  if (outcome.fate != Fate::kAnswered) return outcome.fate != Fate::kCut;
  std::vector<std::optional<std::int64_t>> copies(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const int place = draft.clones[i];
    if (place < 0) continue;
    if (place < response.results_size() && response.results(place).created_submaps_size() == 1) {
      copies[i] = IdOf(response.results(place).created_submaps(0));
    }
    if (!copies[i]) ledger_.Complain("a copy of a list was not told: " + response.ShortDebugString());
  }
  ledger_.OnListMade(ids, copies, response.revision());
  if (made_.size() == kMaxMade) made_.erase(made_.begin());
  made_.push_back(
      {.history = map.history, .name = map.name + "/edits/" + std::to_string(response.revision()), .edits = ids});
  return true;
}

/// Undoes one of the lists made, or does it again if it is undone.
bool ListEditingClient::TakeBack(const FedMap& map, Connection& server) {
  std::vector<std::size_t> mine;
  for (std::size_t i = 0; i < made_.size(); ++i) {
    if (made_[i].history == map.history && IsOf(made_[i].name, map)) mine.push_back(i);
  }
  if (mine.empty()) return true;
  const std::size_t chosen = Happens(50) ? mine.back() : AnyOf(mine);
  MadeList made = made_[chosen];
  made_.erase(made_.begin() + static_cast<std::ptrdiff_t>(chosen));
  const auto ids = ledger_.BeginUndo(made.edits, made.is_undone);
  if (!ids) return true;
  if (made.is_undone) {
    v1::RedoEditsRequest request;
    request.set_map(map.name);
    request.set_edit(made.name);
    request.set_author(author_);
    v1::RedoEditsResponse response;
    const Outcome outcome =
        server.Ask("RedoEdits", {"UNDO_CONFLICT", "UNDO_NOT_KEPT"},
                   [&](grpc::ClientContext* context) { return server.edits->RedoEdits(context, request, &response); });
    return SettleUndo(made, *ids, outcome, response);
  }
  v1::UndoEditsRequest request;
  request.set_map(map.name);
  request.set_edit(made.name);
  request.set_author(author_);
  v1::UndoEditsResponse response;
  const Outcome outcome =
      server.Ask("UndoEdits", {"UNDO_CONFLICT", "UNDO_NOT_KEPT"},
                 [&](grpc::ClientContext* context) { return server.edits->UndoEdits(context, request, &response); });
  return SettleUndo(made, *ids, outcome, response);
}

/// One that was refused stands in the way of others for ever, and of one that was cut off nobody knows: both are
/// forgotten.
template <typename Response>
bool ListEditingClient::SettleUndo(MadeList& made, const std::vector<EditId>& ids, const Outcome& outcome,
                                   const Response& response) {
  if (outcome.fate == Fate::kRefused) ledger_.OnListRefused(ids);
  if (outcome.fate == Fate::kCut) ledger_.OnListCut(ids);
  if (outcome.fate != Fate::kAnswered) return outcome.fate != Fate::kCut;
  if (response.edits_size() != 1 || response.edits(0) != made.name) {
    ledger_.Complain("law 3: " + made.name + " was to be undone or done again, but " + response.ShortDebugString());
  }
  ledger_.OnListMade(ids, std::vector<std::optional<std::int64_t>>(ids.size()), response.revision());
  made.is_undone = !made.is_undone;
  made_.push_back(std::move(made));
  return true;
}

}  // namespace dhpmap::rig
