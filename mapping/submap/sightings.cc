// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/sightings.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace dhpmap {
namespace {

bool SightingComesBefore(const Sighting& sighting, std::string_view session) { return sighting.session < session; }

bool IsUseless(const Sighting& sighting) { return sighting.track_id == 0 && !sighting.has_in_sight; }

/// Whether the entry says no more than one more id of the session of the entry before, and comes in its turn.
bool IsFurtherTrack(const Sighting& sighting, const Sighting& first, const Sighting& before) {
  const bool has_track_alone = sighting == Sighting{.session = first.session, .track_id = sighting.track_id};
  const bool is_in_order = &before == &first || before.track_id < sighting.track_id;
  return has_track_alone && is_in_order && first.track_id != 0 && sighting.track_id != first.track_id;
}

void PutOutOfSight(Sighting& sighting) {
  sighting.has_in_sight = false;
  sighting.num_frames_missed = 0;
}

}  // namespace

Result<Sightings> Sightings::Create(std::vector<Sighting> sightings) {
  std::size_t num_sessions = 0, first = 0;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const bool is_further = i > 0 && sightings[i - 1].session == sightings[i].session;
    if (!is_further) {
      first = i;
      ++num_sessions;
    }
    const bool is_in_order =
        is_further ? IsFurtherTrack(sightings[i], sightings[first], sightings[i - 1]) && i - first < kMostTracks
                   : i == 0 || sightings[i - 1].session < sightings[i].session;
    if (!is_in_order || IsUseless(sightings[i])) return DataLoss("what sessions know of it is damaged");
  }
  if (num_sessions > kMost) return DataLoss("has been seen by more sessions than are kept");
  Sightings created;
  created.all_ = std::move(sightings);
  return created;
}

void Sightings::OnSeen(std::string_view session, std::int64_t frame) {
  Sighting& sighting = FindOrAdd(session);
  sighting.has_in_sight = true;
  sighting.num_frames_missed = 0;
  sighting.last_frame = frame;
}

void Sightings::OnMissed(std::string_view session, std::int64_t frame) {
  if (!IsInSightOf(session)) return;
  Sighting& sighting = FindOrAdd(session);
  ++sighting.num_frames_missed;
  sighting.last_frame = frame;
}

void Sightings::Lapse(std::int32_t max_missed, std::int64_t frame, std::int64_t max_silent_frames) {
  for (Sighting& sighting : all_) {
    const bool is_silent = frame - sighting.last_frame > max_silent_frames;
    if (sighting.num_frames_missed >= max_missed || is_silent) PutOutOfSight(sighting);
  }
  DropUseless();
}

void Sightings::LapseAll() {
  for (Sighting& sighting : all_) PutOutOfSight(sighting);
  DropUseless();
}

void Sightings::SetTrack(std::string_view session, std::uint32_t track_id) {
  FindOrAdd(session).track_id = track_id;
  const auto [begin, end] = EntriesOf(session);
  all_.erase(begin + 1, end);
  DropUseless();
}

void Sightings::AddTrack(std::string_view session, std::uint32_t track_id) {
  Sighting& first = FindOrAdd(session);
  if (first.track_id == 0) first.track_id = track_id;
  const auto [begin, end] = EntriesOf(session);
  const bool is_known = std::any_of(begin, end, [=](const Sighting& known) { return known.track_id == track_id; });
  if (is_known) return;
  // Front ends count up: the smallest is the oldest, as a rule.
  if (static_cast<std::size_t>(end - begin) >= kMostTracks) all_.erase(begin + 1);
  const auto [first_place, end_place] = EntriesOf(session);
  const auto place =
      std::find_if(first_place + 1, end_place, [=](const Sighting& known) { return known.track_id > track_id; });
  all_.insert(place, Sighting{.session = std::string(session), .track_id = track_id});
}

void Sightings::ForgetTrack(std::string_view session, std::uint32_t track_id) {
  if (track_id == 0) return;
  const auto [begin, end] = EntriesOf(session);
  auto found = std::find_if(begin, end, [=](const Sighting& known) { return known.track_id == track_id; });
  if (found == end) return;
  if (found == begin && end - begin > 1) {  // the next id becomes the first
    found = begin + 1;
    begin->track_id = found->track_id;
  }
  if (found != begin) all_.erase(found);
  else found->track_id = 0;
  DropUseless();
}

void Sightings::Merge(const Sightings& other) {
  for (const Sighting& theirs : other.all_) {
    if (theirs.track_id != 0) AddTrack(theirs.session, theirs.track_id);
    Sighting& ours = FindOrAdd(theirs.session);
    if (theirs.has_in_sight) {
      ours.num_frames_missed =
          ours.has_in_sight ? std::min(ours.num_frames_missed, theirs.num_frames_missed) : theirs.num_frames_missed;
      ours.has_in_sight = true;
    }
    ours.last_frame = std::max(ours.last_frame, theirs.last_frame);
  }
}

bool Sightings::IsInSightOf(std::string_view session) const {
  const Sighting* sighting = Find(session);
  return sighting != nullptr && sighting->has_in_sight;
}

bool Sightings::IsInSight() const {
  return std::any_of(all_.begin(), all_.end(), [](const Sighting& sighting) { return sighting.has_in_sight; });
}

bool Sightings::IsDeserted(std::int64_t frame, std::int64_t max_silent_frames) const {
  return IsInSight() && std::none_of(all_.begin(), all_.end(), [&](const Sighting& sighting) {
           return sighting.has_in_sight && frame - sighting.last_frame <= max_silent_frames;
         });
}

std::int32_t Sightings::LeastMissed() const {
  std::int32_t least = std::numeric_limits<std::int32_t>::max();
  for (const Sighting& sighting : all_) {
    if (sighting.has_in_sight) least = std::min(least, sighting.num_frames_missed);
  }
  return least;
}

std::uint32_t Sightings::TrackOf(std::string_view session) const {
  const Sighting* sighting = Find(session);
  return sighting != nullptr ? sighting->track_id : 0;
}

bool Sightings::IsTrackedAs(std::string_view session, std::uint32_t track_id) const {
  const auto begin = std::lower_bound(all_.begin(), all_.end(), session, SightingComesBefore);
  for (auto entry = begin; entry != all_.end() && entry->session == session; ++entry) {
    if (entry->track_id == track_id) return true;
  }
  return false;
}

bool Sightings::HasTrack() const {
  return std::any_of(all_.begin(), all_.end(), [](const Sighting& sighting) { return sighting.track_id != 0; });
}

const Sighting* Sightings::Find(std::string_view session) const {
  const auto found = std::lower_bound(all_.begin(), all_.end(), session, SightingComesBefore);
  return found != all_.end() && found->session == session ? &*found : nullptr;
}

Sighting& Sightings::FindOrAdd(std::string_view session) {
  auto place = std::lower_bound(all_.begin(), all_.end(), session, SightingComesBefore);
  if (place != all_.end() && place->session == session) return *place;
  MakeRoom();
  place = std::lower_bound(all_.begin(), all_.end(), session, SightingComesBefore);
  return *all_.insert(place, Sighting{.session = std::string(session)});
}

std::pair<Sightings::Place, Sightings::Place> Sightings::EntriesOf(std::string_view session) {
  const auto begin = std::lower_bound(all_.begin(), all_.end(), session, SightingComesBefore);
  return {begin, std::find_if(begin, all_.end(), [&](const Sighting& entry) { return entry.session != session; })};
}

void Sightings::MakeRoom() {
  if (all_.size() < kMost) return;
  const Sighting* oldest = nullptr;
  std::size_t num_sessions = 0;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    if (i > 0 && all_[i - 1].session == all_[i].session) continue;  // a further id
    ++num_sessions;
    if (oldest == nullptr || all_[i].last_frame < oldest->last_frame) oldest = &all_[i];
  }
  if (num_sessions < kMost) return;
  const auto [begin, end] = EntriesOf(oldest->session);
  all_.erase(begin, end);
}

void Sightings::DropUseless() { std::erase_if(all_, IsUseless); }

}  // namespace dhpmap
