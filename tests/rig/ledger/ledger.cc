// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/ledger/ledger.h"

#include <cstdlib>
#include <utility>

#include "tests/rig/ledger/sights.h"

namespace dhpmap::rig {
namespace {

/// History of the maps themselves in the book of edits.
constexpr const char* kMaps = "maps";

/// What an object never changes.
std::string IdentityOf(const v1::Submap& submap) {
  v1::Submap identity;
  identity.set_instance_id(submap.instance_id());
  identity.set_kind(submap.kind());
  identity.set_voxel_size_m(submap.voxel_size_m());
  identity.set_truncation_m(submap.truncation_m());
  identity.set_first_observed_stamp_ns(submap.first_observed_stamp_ns());
  return identity.ShortDebugString();
}

}  // namespace

NamedState StateOf(const std::string& history, const v1::Submap& submap) {
  NamedState state{.submap = {history, submap.instance_id()}, .revision = submap.revision()};
  const std::string& etag = submap.etag();
  const auto at = etag.rfind("-e");
  if (at != std::string::npos) state.edited_revision = std::strtoll(etag.c_str() + at + 2, nullptr, 10);
  return state;
}

Moment Ledger::Now() {
  const MutexLock lock(mutex_);
  return ++now_;
}

Progress& Ledger::ProgressOf(const std::string& history) {
  return progress_.try_emplace(history, "history " + history, complaints_).first->second;
}

void Ledger::See(const std::string& history, const v1::Submap& submap, std::int64_t map_revision, Moment asked) {
  const std::string object = history + "/" + std::to_string(submap.instance_id());
  names_.Bind("submap " + object + " at revision " + std::to_string(submap.revision()), submap);
  names_.Bind("etag " + submap.etag(), object + " " + std::to_string(submap.revision()));
  if (submap.instance_id() != 0) names_.Bind("submap " + object, IdentityOf(submap));
  if (submap.revision() > map_revision) {
    complaints_.push_back("law 2: submap " + object + " is of revision " + std::to_string(submap.revision()) +
                          ", beyond its map's " + std::to_string(map_revision));
  }
  const NamedState state = StateOf(history, submap);
  present_[state.submap].newest_edit.Raise(now_, state.edited_revision);
  ++tally_.num_answers;
  ProgressOf(history).OnRevision(map_revision, asked, now_);
}

void Ledger::OnSubmap(const std::string& history, const v1::Submap& submap, std::int64_t map_revision, Moment asked) {
  const MutexLock lock(mutex_);
  ++now_;
  See(history, submap, map_revision, asked);
  book_.OnSeen({history, submap.instance_id()}, SightOf(submap), asked, now_);
}

void Ledger::OnNoSubmap(const std::string& history, std::int64_t id, Moment asked) {
  const MutexLock lock(mutex_);
  ++tally_.num_answers;
  book_.OnAbsent({history, id}, asked, ++now_);
}

void Ledger::SeeListing(const std::string& history, const v1::ListSubmapsResponse& all, Moment asked) {
  std::string state;
  for (const v1::Submap& submap : all.submaps()) {
    See(history, submap, all.revision(), asked);
    state += std::to_string(submap.instance_id()) + ":" + std::to_string(submap.revision()) + " ";
  }
  ++tally_.num_listings;
  names_.Bind("submaps of " + history + " at revision " + std::to_string(all.revision()), state);
}

void Ledger::OnListing(const std::string& history, const v1::ListSubmapsResponse& all, Moment asked) {
  const MutexLock lock(mutex_);
  ++now_;
  SeeListing(history, all, asked);
  book_.OnWhole(history, SightsOf(all), asked, now_);
}

void Ledger::SeeMap(const v1::Map& map, Moment asked) {
  v1::Map state = map;
  state.clear_label_classes();
  state.clear_config();
  names_.Bind("map " + map.history_id() + " at revision " + std::to_string(map.revision()), state);
  ++tally_.num_answers;
  Progress& progress = ProgressOf(map.history_id());
  progress.OnRevision(map.revision(), asked, now_);
  progress.OnFrames(map.revision(), map.num_frames());
}

void Ledger::OnMap(const v1::Map& map, Moment asked) {
  const MutexLock lock(mutex_);
  ++now_;
  SeeMap(map, asked);
}

void Ledger::OnVoxels(const std::string& history, const v1::Submap& state, const std::string& voxels) {
  const MutexLock lock(mutex_);
  ++tally_.num_answers;
  names_.Bind("voxels of submap " + history + "/" + std::to_string(state.instance_id()) + " at revision " +
                  std::to_string(state.revision()),
              voxels);
}

void Ledger::OnRevision(const std::string& history, std::int64_t revision, Moment asked) {
  const MutexLock lock(mutex_);
  ++tally_.num_answers;
  ProgressOf(history).OnRevision(revision, asked, ++now_);
}

void Ledger::OnFinished(const std::string& history, std::int64_t revision, Moment asked) {
  OnRevision(history, revision, asked);
  const MutexLock lock(mutex_);
  ProgressOf(history).OnDurable(revision);
}

void Ledger::OnPageToken(const std::string& history, const std::string& token, std::int64_t revision) {
  const MutexLock lock(mutex_);
  ProgressOf(history).OnToken(token, revision);
}

std::optional<KeptToken> Ledger::TokenToAsk(const std::string& history, std::uint64_t any) {
  const MutexLock lock(mutex_);
  const std::vector<KeptToken>& tokens = ProgressOf(history).tokens();
  if (tokens.empty()) return std::nullopt;
  return tokens[any % tokens.size()];
}

void Ledger::OnPage(const std::string& history, const KeptToken& token, bool is_refused_as_lost,
                    const std::string& answer) {
  const MutexLock lock(mutex_);
  ++(token.is_lost ? tally_.num_lost_tokens_asked : tally_.num_good_tokens_asked);
  ProgressOf(history).OnPage(token, is_refused_as_lost, answer);
}

void Ledger::OnStored(const std::string& history, const std::string& session, std::int64_t sequence) {
  const MutexLock lock(mutex_);
  ++tally_.num_sequences_told;
  ProgressOf(history).OnStored(session, sequence);
}

void Ledger::OnResumed(const std::string& history, const std::string& session, std::optional<std::int64_t> sequence,
                       std::int64_t num_frames) {
  const MutexLock lock(mutex_);
  ++tally_.num_resumed;
  ProgressOf(history).OnResumed(session, sequence);
  if (const std::int64_t num_stored = sequence.value_or(-1) + 1; num_frames != num_stored) {
    complaints_.push_back("law 4: history " + history + " has " + std::to_string(num_frames) + " frames, but session " +
                          session + " has stored " + std::to_string(num_stored));
  }
}

EditId Ledger::Pend(EditId edit, Pending pending) {
  tally_.num_stale_edits += pending.is_stale ? 1 : 0;
  pending_[edit] = std::move(pending);
  return edit;
}

Ledger::Pending Ledger::Settle(EditId edit) { return std::move(pending_.extract(edit).mapped()); }

/// Whether an etag certainly does not hold in a history.
bool Ledger::IsStale(const NamedState& etag, const std::string& history) {
  if (etag.submap.history != history || book_.IsGone(etag.submap, now_)) return true;
  const Present& present = present_[etag.submap];
  const bool is_lost = etag.revision <= present.map_at_restart && etag.revision > present.stored;
  return is_lost || etag.edited_revision < present.newest_edit.At(now_);
}

std::optional<EditId> Ledger::BeginEdit(SubmapEdit edit) {
  const MutexLock lock(mutex_);
  ++now_;
  Pending pending{.what = edit.plan.what, .history = edit.plan.history, .begun = now_};
  pending.is_stale = edit.etag && IsStale(*edit.etag, edit.plan.history);
  edit.plan.is_vain = pending.is_stale;
  const auto id = book_.Begin(std::move(edit.plan), now_);
  if (!id) return std::nullopt;
  return Pend(*id, std::move(pending));
}

void Ledger::OnMade(EditId edit, const v1::Submap* after, std::int64_t map_revision) {
  const MutexLock lock(mutex_);
  ++now_;
  ++tally_.num_edits_made;
  const Pending pending = Settle(edit);
  if (pending.is_stale) complaints_.push_back("law 5: made, with an etag that did not hold: " + pending.what);
  ProgressOf(pending.history).OnDurable(map_revision);
  if (after == nullptr) {
    ProgressOf(pending.history).OnRevision(map_revision, pending.begun, now_);
    return book_.OnMade(edit, std::nullopt, nullptr, now_);
  }
  See(pending.history, *after, map_revision, pending.begun);
  const Sight sight = SightOf(*after);
  book_.OnMade(edit, after->instance_id(), &sight, now_);
}

void Ledger::OnRefused(EditId edit) {
  const MutexLock lock(mutex_);
  ++now_;
  ++tally_.num_edits_refused;
  (void)Settle(edit);
  book_.OnRefused(edit);
}

void Ledger::OnCut(EditId edit) {
  const MutexLock lock(mutex_);
  ++tally_.num_edits_cut;
  (void)Settle(edit);
  book_.OnCut(edit);
}

std::optional<EditId> Ledger::BeginMapEdit(std::int64_t number, std::string what, Wish change, bool is_stale) {
  const MutexLock lock(mutex_);
  const auto id = book_.Begin({.what = what,
                               .history = kMaps,
                               .id = number,
                               .change = std::move(change),
                               .before = {.presence = Presence::kGone},
                               .is_vain = is_stale},
                              ++now_);
  if (!id) return std::nullopt;
  return Pend(*id, {.what = std::move(what), .history = kMaps, .begun = now_, .is_stale = is_stale});
}

void Ledger::OnMapMade(EditId edit, const v1::Map* after) {
  const MutexLock lock(mutex_);
  ++now_;
  ++tally_.num_edits_made;
  const Pending pending = Settle(edit);
  if (pending.is_stale) complaints_.push_back("law 5: made, with an etag that did not hold: " + pending.what);
  if (after == nullptr) return book_.OnMade(edit, std::nullopt, nullptr, now_);
  SeeMap(*after, pending.begun);
  ProgressOf(after->history_id()).OnDurable(after->revision());
  const Sight sight = SightOf(*after);
  book_.OnMade(edit, std::nullopt, &sight, now_);
}

void Ledger::OnSeenMap(std::int64_t number, const v1::Map* map, Moment asked) {
  const MutexLock lock(mutex_);
  ++now_;
  if (map == nullptr) return book_.OnAbsent({kMaps, number}, asked, now_);
  SeeMap(*map, asked);
  book_.OnSeen({kMaps, number}, SightOf(*map), asked, now_);
}

void Ledger::OnRestarted(const v1::Map& map, const v1::ListSubmapsResponse& all, Moment asked) {
  const MutexLock lock(mutex_);
  ++now_;
  const std::string& history = map.history_id();
  ProgressOf(history).OnRestarted(map.num_frames());
  for (auto it = present_.lower_bound({history, 0}); it != present_.end() && it->first.history == history; ++it) {
    it->second = {.map_at_restart = all.revision()};
  }
  for (const v1::Submap& submap : all.submaps()) present_[{history, submap.instance_id()}].stored = submap.revision();
  SeeMap(map, asked);
  SeeListing(history, all, asked);
  tally_.num_cut_edits_made += book_.OnRestarted(history, SightsOf(all), asked, now_);
}

void Ledger::OnMapsRestarted(const std::map<std::int64_t, v1::Map>& maps, Moment asked) {
  const MutexLock lock(mutex_);
  ++now_;
  std::map<std::int64_t, Sight> sights;
  for (const auto& [number, map] : maps) {
    SeeMap(map, asked);
    sights[number] = SightOf(map);
  }
  tally_.num_cut_edits_made += book_.OnRestarted(kMaps, sights, asked, now_);
}

void Ledger::Complain(std::string text) {
  const MutexLock lock(mutex_);
  complaints_.push_back(std::move(text));
}

Complaints Ledger::complaints() const {
  const MutexLock lock(mutex_);
  return complaints_;
}

Tally Ledger::tally() const {
  const MutexLock lock(mutex_);
  Tally tally = tally_;
  tally.num_names = static_cast<std::int64_t>(names_.size());
  return tally;
}

}  // namespace dhpmap::rig
