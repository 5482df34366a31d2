// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap {

/// What one session of frames knows of a thing.
struct Sighting {
  std::string session;                 ///< empty: of streams that name none
  std::uint32_t track_id = 0;          ///< what its front end with persistent ids calls the thing; 0 = nothing
  bool has_in_sight = false;           ///< it has seen the thing lately: see UpdateActivity
  std::int32_t num_frames_missed = 0;  ///< while in sight: its frames without the thing since the last one with it
  std::int64_t last_frame = 0;         ///< its last one while in sight: the number in the map, from 1

  friend bool operator==(const Sighting&, const Sighting&) = default;
};

/// What each session knows of a thing, so that no robot's frames count for another's. Of at most kMost sessions: that
/// whose last frame is the oldest goes for a new one. What neither has a track id nor is in sight is not kept. Value
/// type.
class Sightings {
 public:
  static constexpr std::size_t kMost = 64;

  Sightings() = default;
  /// DATA_LOSS unless they are by ascending session, each once and worth to be kept, and are not too many.
  static Result<Sightings> Create(std::vector<Sighting> sightings);

  /// The thing was in frame `frame` of the map, which is one of the session.
  void OnSeen(std::string_view session, std::int64_t frame);
  /// A frame of the session was without it. Nothing happens where the session has not had it in sight.
  void OnMissed(std::string_view session, std::int64_t frame);
  /// Out of sight: for sessions that have missed it `max_missed` times, and for those of which none of the last
  /// `max_silent_frames` frames up to `frame` was.
  void Lapse(std::int32_t max_missed, std::int64_t frame, std::int64_t max_silent_frames);
  void LapseAll();
  void SetTrack(std::string_view session, std::uint32_t track_id);
  /// Of two things that are one: where both have a track id of one session, that of this one stays.
  void Merge(const Sightings& other);

  [[nodiscard]] bool IsInSightOf(std::string_view session) const;
  [[nodiscard]] bool IsInSight() const;
  /// Somebody has it in sight, but nobody has sent one of the last `max_silent_frames` frames up to `frame`.
  [[nodiscard]] bool IsDeserted(std::int64_t frame, std::int64_t max_silent_frames) const;
  /// Of those that have it in sight, of whom there is one at least.
  [[nodiscard]] std::int32_t LeastMissed() const;
  /// 0: none.
  [[nodiscard]] std::uint32_t TrackOf(std::string_view session) const;
  [[nodiscard]] bool HasTrack() const;

  /// By ascending session.
  [[nodiscard]] const std::vector<Sighting>& all() const { return all_; }
  friend bool operator==(const Sightings&, const Sightings&) = default;

 private:
  [[nodiscard]] const Sighting* Find(std::string_view session) const;
  Sighting& FindOrAdd(std::string_view session);
  void MakeRoom();
  void DropUseless();

  std::vector<Sighting> all_;
};

}  // namespace dhpmap
