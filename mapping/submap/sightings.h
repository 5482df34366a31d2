// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap {

/// What one session of frames knows of a thing. Of a session that calls it by several ids the first entry says all that
/// there is to say, the others have an id and nothing else.
struct Sighting {
  std::string session;                 ///< empty: of streams that name none
  std::uint32_t track_id = 0;          ///< what its front end with persistent ids calls the thing; 0 = nothing
  bool has_in_sight = false;           ///< it has seen the thing lately: see UpdateActivity
  std::int32_t num_frames_missed = 0;  ///< while in sight: its frames without the thing since the last one with it
  std::int64_t last_frame = 0;         ///< its last one while in sight: the number in the map, from 1

  friend bool operator==(const Sighting&, const Sighting&) = default;
};

/// What each session knows of a thing, so that no robot's frames count for another's. Of at most kMost sessions: that
/// whose last frame is the oldest goes for a new one. What neither has a track id nor is in sight is not kept. A
/// session has several track ids of what was merged of its things, kMostTracks at most: for one more, the smallest but
/// the first goes, as front ends count up and the newest is the one in use. Value type.
class Sightings {
 public:
  static constexpr std::size_t kMost = 64;        ///< sessions
  static constexpr std::size_t kMostTracks = 64;  ///< of a session

  Sightings() = default;
  /// DATA_LOSS unless they are by ascending session, each worth to be kept, further ids of a session ascending, each
  /// once and without anything else, and are not too many.
  static Result<Sightings> Create(std::vector<Sighting> sightings);

  /// The thing was in frame `frame` of the map, which is one of the session.
  void OnSeen(std::string_view session, std::int64_t frame);
  /// A frame of the session was without it. Nothing happens where the session has not had it in sight.
  void OnMissed(std::string_view session, std::int64_t frame);
  /// Out of sight: for sessions that have missed it `max_missed` times, and for those of which none of the last
  /// `max_silent_frames` frames up to `frame` was.
  void Lapse(std::int32_t max_missed, std::int64_t frame, std::int64_t max_silent_frames);
  void LapseAll();
  /// The session's only one from now on; 0: it has none.
  void SetTrack(std::string_view session, std::uint32_t track_id);
  /// Beside those that the session has, of which one goes if they are kMostTracks; not 0.
  void AddTrack(std::string_view session, std::uint32_t track_id);
  void ForgetTrack(std::string_view session, std::uint32_t track_id);
  /// Of two things that are one: where both have a track id of one session it knows the whole by either, by that of
  /// this one first.
  void Merge(const Sightings& other);

  [[nodiscard]] bool IsInSightOf(std::string_view session) const;
  [[nodiscard]] bool IsInSight() const;
  /// Somebody has it in sight, but nobody has sent one of the last `max_silent_frames` frames up to `frame`.
  [[nodiscard]] bool IsDeserted(std::int64_t frame, std::int64_t max_silent_frames) const;
  /// Of those that have it in sight, of whom there is one at least.
  [[nodiscard]] std::int32_t LeastMissed() const;
  /// The first one; 0: none.
  [[nodiscard]] std::uint32_t TrackOf(std::string_view session) const;
  /// Whether it is one of the session's; not 0.
  [[nodiscard]] bool IsTrackedAs(std::string_view session, std::uint32_t track_id) const;
  [[nodiscard]] bool HasTrack() const;

  /// By ascending session, then the first track id and the others, ascending.
  [[nodiscard]] const std::vector<Sighting>& all() const { return all_; }
  friend bool operator==(const Sightings&, const Sightings&) = default;

 private:
  using Place = std::vector<Sighting>::iterator;

  [[nodiscard]] const Sighting* Find(std::string_view session) const;
  /// The session's first entry.
  Sighting& FindOrAdd(std::string_view session);
  std::pair<Place, Place> EntriesOf(std::string_view session);
  void MakeRoom();
  void DropUseless();

  std::vector<Sighting> all_;
};

}  // namespace dhpmap
