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

/// Active things are matched first; inactive things may be refined (paper II-D).
enum class Activity : std::uint8_t { kActive = 0, kInactive = 1 };

/// Whether an object is still where it was seen.
enum class Presence : std::uint8_t {
  kPresent = 0,
  kAbsent = 1,  ///< sensors have looked through most of its surface since: kept, but left out of answers
};

/// Number of observations of a class in a whole submap.
struct ClassTotal {
  ClassId id;
  std::uint64_t count = 0;
  constexpr bool operator==(const ClassTotal&) const = default;
};

/// All of a submap except its voxels: one row of the store. List new members in submap_fields.h.
struct SubmapInfo {
  SubmapId id;
  Panoptic panoptic = Panoptic::kUnknown;
  /// Of a thing: the most frequent class of class_counts, unless class_is_fixed. Of a background: the class for which
  /// it was created. Meaningless while panoptic is kUnknown.
  ClassId class_id;
  /// An edit has set the class; fusion does not change class_id.
  bool class_is_fixed = false;
  std::string display_name;  ///< set by an edit; empty: see DisplayNameOf
  Transform T_map_submap = Transform::Identity();
  double voxel_size_m = 0;
  double truncation_m = 0;

  /// Number of observations of each class, summed over its voxels except those that it holds by conclusion (see
  /// LabelBlock), by ascending class (paper II-C, label of a submap).
  std::vector<ClassTotal> class_counts;
  float instance_confidence = 1.0f;  ///< share of its voxels' instance counts that are its own

  Activity activity = Activity::kActive;
  bool is_confirmed = true;              ///< a new thing is confirmed by re-observation
  std::int64_t num_frames_observed = 0;  ///< frames with a segment of it
  /// Consecutive frames without a segment of it: of the session with the fewest, or of any if no session has it in
  /// view.
  std::int32_t num_frames_missed = 0;
  std::int32_t num_frames_overlooked = 0;  ///< frames since, of any session, in which it was in view and not hidden
  std::int64_t first_observed_ns = 0;
  std::int64_t last_observed_ns = 0;
  Presence presence = Presence::kPresent;  ///< of a thing; see UpdatePresence
  std::int64_t last_contradicted_ns = 0;   ///< when a voxel of it last became contradicted (GoneBlock); 0 = never
  /// An edit has moved or cloned it: observations at its place do not contradict it.
  bool is_placed = false;
  /// Read-only for mapping and refinement, except last_observed_ns. Edits still apply.
  bool is_locked = false;
  /// The first id of this object from a front end with persistent segment ids; 0 = none. The sightings name its
  /// session. If they name no track, the id may be of any session: maps of schema 7 and before do not store the
  /// session.
  std::uint32_t track_id = 0;
  Sightings sightings;  ///< of a thing, by session
  /// Map revision that last changed anything of this submap.
  std::int64_t revision = 0;
  /// Map revision of the last edit or merge of this submap; 0: only frames and refinement have changed it.
  std::int64_t edited_revision = 0;

  /// Share of the counts that went to class_id.
  [[nodiscard]] float ClassConfidence() const;
  /// Whether segments of this class may be of this submap: it has the class; or an edit has set another one, and frames
  /// observed it as this class (the most frequent of class_counts, or one with a third of the counts, because later
  /// frames may use the set class).
  [[nodiscard]] bool IsSeenAs(ClassId wanted) const;
};

/// Whether an edit has placed, relabelled or named it, or has cloned it. Frames do not change these properties.
bool IsEdited(const SubmapInfo& info);

}  // namespace dhpmap
