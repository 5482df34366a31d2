// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/base/transform.h"
#include "mapping/labels/panoptic.h"
#include "mapping/submap/sightings.h"

namespace dhpmap {

/// Active things take new observations first; inactive ones are settled and may be refined (paper II-D).
enum class Activity : std::uint8_t { kActive = 0, kInactive = 1 };

/// Whether an object is still where it was seen.
enum class Presence : std::uint8_t {
  kPresent = 0,
  kAbsent = 1,  ///< most of its surface was looked through since: kept, but no part of what the map answers
};

/// How often a class was observed in all of a submap.
struct ClassTotal {
  ClassId id;
  std::uint64_t count = 0;
  constexpr bool operator==(const ClassTotal&) const = default;
};

/// All of a submap but its voxels: one row of the store. A new member is listed in submap_fields.h.
struct SubmapInfo {
  SubmapId id;
  Panoptic panoptic = Panoptic::kUnknown;
  /// Of a thing the most frequent class of class_counts, unless class_is_fixed; of a background the one it was made
  /// for. Meaningless while panoptic is kUnknown.
  ClassId class_id;
  /// Set by a user's relabelling; fusion then leaves class_id alone.
  bool class_is_fixed = false;
  std::string display_name;  ///< as somebody has set it; empty: see DisplayNameOf
  Transform T_map_submap = Transform::Identity();
  double voxel_size_m = 0;
  double truncation_m = 0;

  /// Sum over its voxels, but those that it holds by conclusion (see LabelBlock), of how often each class was observed,
  /// by ascending class (paper II-C, label of a submap).
  std::vector<ClassTotal> class_counts;
  float instance_confidence = 1.0f;  ///< share of its voxels' instance counts that are its own

  Activity activity = Activity::kActive;
  bool is_confirmed = true;              ///< a new thing is confirmed by re-observation
  std::int64_t num_frames_observed = 0;  ///< frames with a segment of it
  /// Consecutive frames without one, of the session that has missed it least; of any where none has it in sight.
  std::int32_t num_frames_missed = 0;
  std::int32_t num_frames_overlooked = 0;  ///< frames since, of any session, in which it was in view and not hidden
  std::int64_t first_observed_ns = 0;
  std::int64_t last_observed_ns = 0;
  Presence presence = Presence::kPresent;  ///< of a thing; see UpdatePresence
  std::int64_t last_contradicted_ns = 0;   ///< when a voxel of it last became contradicted (GoneBlock); 0 = never
  /// Somebody has put it where it is (moved, or cloned it): what sensors see there says nothing against it.
  bool is_placed = false;
  /// Somebody has locked it: mapping and refinement leave all of it as it is but last_observed_ns. Edits do not mind.
  bool is_locked = false;
  /// Id under which a front end with persistent segment ids knew this object first; 0 = none. Of which session say the
  /// sightings; where these name no track, it is that of any: maps of schema 7 and before do not say whose it was.
  std::uint32_t track_id = 0;
  Sightings sightings;  ///< of a thing: what each session of frames knows of it
  /// Map revision that last changed anything of this submap.
  std::int64_t revision = 0;
  /// Map revision of the last edit or merge of this submap; 0: only frames and refinement have changed it.
  std::int64_t edited_revision = 0;

  /// Share of the counts that went to class_id.
  [[nodiscard]] float ClassConfidence() const;
  /// Whether frames that call something so may mean this: it has the class, or somebody has set it and frames saw it as
  /// that one (the most frequent of class_counts, or with a third of the counts: later frames may use the set one).
  [[nodiscard]] bool IsSeenAs(ClassId wanted) const;
};

/// Whether a person has edited it: placed, relabelled or named it, or made it by cloning. Frames leave it as it is.
bool IsEdited(const SubmapInfo& info);

}  // namespace dhpmap
