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

/// How one feed session sees a thing. If the session has several ids for it, the first entry holds all values, the
/// others only an id.
struct Sighting {
  std::string session;                 ///< empty: streams without a session name
  std::uint32_t track_id = 0;          ///< the thing's persistent id in that session; 0 for none
  bool has_in_sight = false;           ///< seen lately: see UpdateActivity
  std::int32_t num_frames_missed = 0;  ///< while in sight: the session's frames since it last saw the thing
  std::int64_t last_frame = 0;  ///< while in sight: number in the map, from 1, of the session's last frame with it

  friend bool operator==(const Sighting&, const Sighting&) = default;
};

/// The sightings of a thing by session, so that one robot's frames do not count for another. At most kMost sessions;
/// the one with the oldest last frame is replaced. Entries with neither a track id nor sight are dropped. After merges
/// a session may have several track ids, at most kMostTracks; beyond, the smallest but the first is dropped, because
/// front ends count up and use the newest. Value type.
class Sightings {
 public:
  static constexpr std::size_t kMost = 64;        ///< sessions
  static constexpr std::size_t kMostTracks = 64;  ///< of a session

  Sightings() = default;
  /// DATA_LOSS unless sessions ascend, each entry has content, further ids of a session ascend, are unique and hold
  /// nothing else, and the limits are kept.
  static Result<Sightings> Create(std::vector<Sighting> sightings);

  /// Frame `frame` of the map, by this session, shows the thing.
  void OnSeen(std::string_view session, std::int64_t frame);
  /// A frame of the session does not show it. No effect unless the session has it in sight.
  void OnMissed(std::string_view session, std::int64_t frame);
  /// Drops it from sight for sessions that missed it `max_missed` times, and for those that sent none of the last
  /// `max_silent_frames` frames up to `frame`.
  void Lapse(std::int32_t max_missed, std::int64_t frame, std::int64_t max_silent_frames);
  void LapseAll();
  /// Sets the session's only track id; 0 for none.
  void SetTrack(std::string_view session, std::uint32_t track_id);
  /// Adds a track id to those of the session, dropping one beyond kMostTracks; not 0.
  void AddTrack(std::string_view session, std::uint32_t track_id);
  void ForgetTrack(std::string_view session, std::uint32_t track_id);
  /// For two things that are merged: a session keeps the track ids of both, this one's first.
  void Merge(const Sightings& other);

  [[nodiscard]] bool IsInSightOf(std::string_view session) const;
  [[nodiscard]] bool IsInSight() const;
  /// A session has it in sight, but none of these sent one of the last `max_silent_frames` frames up to `frame`.
  [[nodiscard]] bool IsDeserted(std::int64_t frame, std::int64_t max_silent_frames) const;
  /// Over the sessions that have it in sight; there must be one.
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
