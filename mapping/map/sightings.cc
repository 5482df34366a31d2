// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/sightings.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace dhpmap {
namespace {

bool ComesBefore(const Sighting& sighting, std::string_view session) { return sighting.session < session; }

bool IsUseless(const Sighting& sighting) { return sighting.track_id == 0 && !sighting.has_in_sight; }

void PutOutOfSight(Sighting& sighting) {
  sighting.has_in_sight = false;
  sighting.num_frames_missed = 0;
}

}  // namespace

Result<Sightings> Sightings::Create(std::vector<Sighting> sightings) {
  if (sightings.size() > kMost) return DataLoss("has been seen by more sessions than are kept");
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const bool is_in_order = i == 0 || sightings[i - 1].session < sightings[i].session;
    if (!is_in_order || IsUseless(sightings[i])) return DataLoss("what sessions know of it is damaged");
  }
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
  DropUseless();
}

void Sightings::Merge(const Sightings& other) {
  for (const Sighting& theirs : other.all_) {
    Sighting& ours = FindOrAdd(theirs.session);
    if (ours.track_id == 0) ours.track_id = theirs.track_id;
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

bool Sightings::HasTrack() const {
  return std::any_of(all_.begin(), all_.end(), [](const Sighting& sighting) { return sighting.track_id != 0; });
}

const Sighting* Sightings::Find(std::string_view session) const {
  const auto found = std::lower_bound(all_.begin(), all_.end(), session, ComesBefore);
  return found != all_.end() && found->session == session ? &*found : nullptr;
}

Sighting& Sightings::FindOrAdd(std::string_view session) {
  auto place = std::lower_bound(all_.begin(), all_.end(), session, ComesBefore);
  if (place != all_.end() && place->session == session) return *place;
  MakeRoom();
  place = std::lower_bound(all_.begin(), all_.end(), session, ComesBefore);
  return *all_.insert(place, Sighting{.session = std::string(session)});
}

void Sightings::MakeRoom() {
  if (all_.size() < kMost) return;
  all_.erase(std::min_element(all_.begin(), all_.end(),
                              [](const Sighting& a, const Sighting& b) { return a.last_frame < b.last_frame; }));
}

void Sightings::DropUseless() { std::erase_if(all_, IsUseless); }

}  // namespace dhpmap
