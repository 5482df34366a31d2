// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "tests/rig/clients/clients.h"

namespace dhpmap::rig {
namespace {

constexpr std::size_t kMaxRemembered = 400;
constexpr int kMaxCopies = 15;

/// Far above the corridor, where no camera looks: mapping leaves what is there alone.
constexpr int kLowestCopy_mm = 50'000, kHighestCopy_mm = 90'000;

bool IsCopyOrMoved(const v1::Submap& submap) { return submap.map_from_submap().translation_m().z() != 0; }

std::string Described(const char* what, const std::string& name, const std::string& etag) {
  return std::string(what) + " " + name + (etag.empty() ? " without an etag" : " with etag " + etag);
}

}  // namespace

void EditingClient::Run(const Life& life) {
  Connection server(life, ledger_);
  if (!LookAtSmallMap(server)) return;
  std::vector<const FedMap*> edited;
  for (const FedMap& map : life.maps) {
    if (map.is_edited) edited.push_back(&map);
  }
  if (number_ == 0 && !DeleteWhatIsOver(life, server)) return;
  bool goes_on = true;
  while (goes_on) {
    goes_on = edited.empty() || Happens(20) ? EditSmallMap(server) : EditSubmaps(*AnyOf(edited), server);
  }
}

bool EditingClient::DeleteWhatIsOver(const Life& life, Connection& server) {
  for (const std::string& name : life.to_be_deleted) {
    v1::DeleteMapRequest request;
    request.set_name(name);
    v1::DeleteMapResponse response;
    const Outcome outcome = server.Ask("DeleteMap", {}, [&](grpc::ClientContext* context) {
      return server.maps->DeleteMap(context, request, &response);
    });
    if (outcome.fate == Fate::kCut) return false;
  }
  return true;
}

// Submaps.

bool EditingClient::EditSubmaps(const FedMap& map, Connection& server) {
  const Moment asked = ledger_.Now();
  v1::ListSubmapsResponse all;
  if (server.List(map.name, all).fate != Fate::kAnswered) return false;
  ledger_.OnListing(map.history, all, asked);
  bool with_etag = Happens(60);
  const auto read = Choose(map, all, with_etag);
  Remember(map.history, AnyOf(*all.mutable_submaps()));
  if (!read) return true;
  const auto num_copies = std::count_if(all.submaps().begin(), all.submaps().end(), IsCopyOrMoved);
  const int chance = Any(100);
  if (chance < 40) return Update(map, *read, with_etag, server);
  const bool may_copy = read->submap.kind() == v1::LabelClass::THING && num_copies < kMaxCopies;
  if (chance < 75 && may_copy) return Copy(map, *read, with_etag, server);
  return Delete(map, *read, with_etag, server);
}

/// An object as it is now, or as it was read at any time before, in this life of the server or another.
std::optional<EditingClient::ReadState> EditingClient::Choose(const FedMap& map, const v1::ListSubmapsResponse& all,
                                                              bool& with_etag) {
  if (Happens(35) && !read_.empty()) {
    const ReadState& read = AnyOf(read_);
    with_etag = true;
    if (read.submap.name().starts_with(map.name + "/")) return read;
  }
  const v1::Submap& submap = AnyOf(all.submaps());
  if (submap.instance_id() == 0) return std::nullopt;
  return ReadState{.history = map.history, .submap = submap};
}

void EditingClient::Remember(const std::string& history, const v1::Submap& submap) {
  if (submap.instance_id() == 0) return;
  if (read_.size() < kMaxRemembered) read_.push_back({history, submap});
  else AnyOf(read_) = {history, submap};
}

SubmapEdit EditingClient::Plan(const FedMap& map, const ReadState& read, bool with_etag, std::string what) {
  SubmapEdit edit{.plan = {.what = std::move(what), .history = map.history, .id = read.submap.instance_id()}};
  if (with_etag) edit.etag = StateOf(read.history, read.submap);
  return edit;
}

bool EditingClient::Copy(const FedMap& map, const ReadState& read, bool with_etag, Connection& server) {
  v1::CloneSubmapRequest request;
  request.set_name(read.submap.name());
  request.set_display_name(NewName());
  request.mutable_map_from_submap()->mutable_translation_m()->set_x(Any(3000) * 1e-3);
  request.mutable_map_from_submap()->mutable_translation_m()->set_z(
      (kLowestCopy_mm + Any(kHighestCopy_mm - kLowestCopy_mm)) * 1e-3);
  if (with_etag) request.set_etag(read.submap.etag());
  SubmapEdit edit = Plan(map, read, with_etag, Described("CloneSubmap", request.name(), request.etag()));
  edit.plan.id.reset();
  edit.plan.before.presence = Presence::kGone;
  const v1::Vector3& p = request.map_from_submap().translation_m();
  edit.plan.change = {.presence = Presence::kThere,
                      .display_name = request.display_name(),
                      .position_m = Eigen::Vector3d(p.x(), p.y(), p.z())};
  const auto id = ledger_.BeginEdit(std::move(edit));
  if (!id) return true;
  v1::CloneSubmapResponse response;
  const Outcome outcome = server.Ask(
      "CloneSubmap", {"SUBMAP_NOT_FOUND", "MERGED_INTO", "ETAG_MISMATCH"},
      [&](grpc::ClientContext* context) { return server.submaps->CloneSubmap(context, request, &response); });
  if (outcome.fate == Fate::kAnswered) Remember(map.history, response.submap());
  return Settle(*id, outcome, &response.submap(), response.revision());
}

bool EditingClient::Update(const FedMap& map, const ReadState& read, bool with_etag, Connection& server) {
  v1::UpdateSubmapRequest request;
  v1::Submap& submap = *request.mutable_submap();
  submap.set_name(read.submap.name());
  if (with_etag) submap.set_etag(read.submap.etag());
  SubmapEdit edit = Plan(map, read, with_etag, Described("UpdateSubmap", submap.name(), submap.etag()));
  submap.set_display_name(NewName());
  request.mutable_update_mask()->add_paths("display_name");
  edit.plan.change.display_name = submap.display_name();
  if (read.submap.kind() == v1::LabelClass::THING && Happens(50)) {
    v1::Vector3& p = *submap.mutable_map_from_submap()->mutable_translation_m();
    p.set_z((kLowestCopy_mm + Any(kHighestCopy_mm - kLowestCopy_mm)) * 1e-3);
    request.mutable_update_mask()->add_paths("map_from_submap");
    edit.plan.change.position_m = Eigen::Vector3d(p.x(), p.y(), p.z());
  }
  if (read.submap.kind() == v1::LabelClass::THING && Happens(50)) {
    submap.set_class_id(1 + Any(kNumThingClasses));
    request.mutable_update_mask()->add_paths("class_id");
    edit.plan.change.class_id = submap.class_id();
  }
  const auto id = ledger_.BeginEdit(std::move(edit));
  if (!id) return true;
  v1::UpdateSubmapResponse response;
  const Outcome outcome = server.Ask(
      "UpdateSubmap", {"SUBMAP_NOT_FOUND", "MERGED_INTO", "ETAG_MISMATCH"},
      [&](grpc::ClientContext* context) { return server.submaps->UpdateSubmap(context, request, &response); });
  if (outcome.fate == Fate::kAnswered) Remember(map.history, response.submap());
  return Settle(*id, outcome, &response.submap(), response.revision());
}

bool EditingClient::Delete(const FedMap& map, const ReadState& read, bool with_etag, Connection& server) {
  v1::DeleteSubmapRequest request;
  request.set_name(read.submap.name());
  if (with_etag) request.set_etag(read.submap.etag());
  SubmapEdit edit = Plan(map, read, with_etag, Described("DeleteSubmap", request.name(), request.etag()));
  edit.plan.change.presence = Presence::kGone;
  const auto id = ledger_.BeginEdit(std::move(edit));
  if (!id) return true;
  v1::DeleteSubmapResponse response;
  const Outcome outcome = server.Ask(
      "DeleteSubmap", {"SUBMAP_NOT_FOUND", "MERGED_INTO", "ETAG_MISMATCH"},
      [&](grpc::ClientContext* context) { return server.submaps->DeleteSubmap(context, request, &response); });
  return Settle(*id, outcome, nullptr, response.revision());
}

bool EditingClient::Settle(EditId edit, const Outcome& outcome, const v1::Submap* after, std::int64_t map_revision) {
  if (outcome.fate == Fate::kAnswered) ledger_.OnMade(edit, after, map_revision);
  else if (outcome.fate == Fate::kRefused) ledger_.OnRefused(edit);
  else ledger_.OnCut(edit);
  return outcome.fate != Fate::kCut;
}

// The small map.

bool EditingClient::EditSmallMap(Connection& server) {
  if (!small_) return CreateSmallMap(server);
  const int chance = Any(100);
  if (chance < 50) return RenameSmallMap(server);
  if (chance < 80) return DeleteSmallMap(server);
  return LookAtSmallMap(server);
}

bool EditingClient::LookAtSmallMap(Connection& server) {
  const Moment asked = ledger_.Now();
  v1::Map map;
  const Outcome outcome = server.GetMap(small_map_, map);
  if (outcome.fate == Fate::kCut) return false;
  const bool is_there = outcome.fate == Fate::kAnswered;
  ledger_.OnSeenMap(number_, is_there ? &map : nullptr, asked);
  small_ = is_there ? std::optional(map) : std::nullopt;
  return true;
}

bool EditingClient::CreateSmallMap(Connection& server) {
  const v1::CreateMapRequest request = CorridorMap(MapIdOf(small_map_), NewName());
  const auto id = ledger_.BeginMapEdit(number_, "CreateMap " + small_map_,
                                       {.presence = Presence::kThere, .display_name = request.display_name()}, false);
  if (!id) return true;
  v1::CreateMapResponse response;
  const Outcome outcome = server.Ask("CreateMap", {}, [&](grpc::ClientContext* context) {
    return server.maps->CreateMap(context, request, &response);
  });
  return SettleSmall(*id, outcome, false, &response.map());
}

/// The present one, none, or one that is past.
std::string EditingClient::ChooseSmallEtag(bool& is_stale) {
  const std::string any = small_etags_.empty() ? std::string() : AnyOf(small_etags_);
  is_stale = !any.empty() && any != small_->etag() && Happens(40);
  if (is_stale) return any;
  return Happens(50) ? small_->etag() : std::string();
}

bool EditingClient::RenameSmallMap(Connection& server) {
  bool is_stale = false;
  v1::UpdateMapRequest request;
  request.mutable_map()->set_name(small_map_);
  request.mutable_map()->set_display_name(NewName());
  request.mutable_map()->set_etag(ChooseSmallEtag(is_stale));
  const auto id = ledger_.BeginMapEdit(number_, Described("UpdateMap", small_map_, request.map().etag()),
                                       {.display_name = request.map().display_name()}, is_stale);
  if (!id) return true;
  v1::UpdateMapResponse response;
  const Outcome outcome = server.Ask("UpdateMap", {"ETAG_MISMATCH"}, [&](grpc::ClientContext* context) {
    return server.maps->UpdateMap(context, request, &response);
  });
  return SettleSmall(*id, outcome, is_stale, &response.map());
}

bool EditingClient::DeleteSmallMap(Connection& server) {
  bool is_stale = false;
  v1::DeleteMapRequest request;
  request.set_name(small_map_);
  request.set_etag(ChooseSmallEtag(is_stale));
  const auto id = ledger_.BeginMapEdit(number_, Described("DeleteMap", small_map_, request.etag()),
                                       {.presence = Presence::kGone}, is_stale);
  if (!id) return true;
  v1::DeleteMapResponse response;
  const Outcome outcome = server.Ask("DeleteMap", {"ETAG_MISMATCH"}, [&](grpc::ClientContext* context) {
    return server.maps->DeleteMap(context, request, &response);
  });
  return SettleSmall(*id, outcome, is_stale, nullptr);
}

bool EditingClient::SettleSmall(EditId edit, const Outcome& outcome, bool is_stale, const v1::Map* after) {
  if (outcome.fate == Fate::kCut) {
    ledger_.OnCut(edit);
    return false;
  }
  if (outcome.fate == Fate::kRefused) {
    ledger_.OnRefused(edit);
    if (!is_stale) ledger_.Complain("an edit of " + small_map_ + " was refused for no reason: " + outcome.reason);
    return true;
  }
  ledger_.OnMapMade(edit, after);
  if (small_) small_etags_.push_back(small_->etag());
  if (small_etags_.size() > kMaxRemembered) small_etags_.erase(small_etags_.begin());
  small_ = after == nullptr ? std::nullopt : std::optional(*after);
  return true;
}

}  // namespace dhpmap::rig
