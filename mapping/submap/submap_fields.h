// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>

#include "mapping/base/transform.h"
#include "mapping/submap/submap_info.h"
#include "mapping/submap/submap_part.h"

namespace dhpmap {

/// How undo treats a field that has changed since the edit.
enum class UndoRule : std::uint8_t {
  kOwn,            ///< by its own rule, see ApplyDelta
  kUnlessChanged,  ///< restored unless frames or edits have changed it since
};

/// Properties of a field that all generic code needs.
struct FieldRules {
  const char* name;  ///< column name in the store and in messages
  /// First version of the row checksum that covers it (storage/FORMAT.md), and its place among the covered columns:
  /// frozen. A new field takes the next version and the next place.
  int since = 0;
  int place = 0;
  std::optional<SubmapPart> told_as = std::nullopt;  ///< how watchers are told of a change; none: they are not
  UndoRule undo = UndoRule::kOwn;
  // Limits of a number in an imported file; values beyond are refused.
  std::int64_t least = std::numeric_limits<std::int64_t>::min();
  std::int64_t most = std::numeric_limits<std::int64_t>::max();
};

template <auto kMember>
struct SubmapField : FieldRules {
  /// `info` may be const.
  template <typename Info>
  static constexpr auto& Of(Info& info) {
    return info.*kMember;
  }
};

namespace field_range {
/// Revisions, frames and times up to this can be added and subtracted without overflow.
inline constexpr std::int64_t kMostNumber = (std::int64_t{1} << 62) - 1;
/// Limit of 32-bit frame counts that leaves room for years of counting.
inline constexpr std::int64_t kMostMissed = std::int64_t{1} << 30;
}  // namespace field_range

/// The one list of the fields of a SubmapInfo. Rows in the store, logs, watch events, undo, checks of imported maps and
/// equality in tests follow from it. Logs use its order: new fields go to the end.
inline constexpr auto kSubmapFields = [] {
  using enum SubmapPart;
  using enum UndoRule;
  using Info = SubmapInfo;
  constexpr std::int64_t kMost = field_range::kMostNumber, kMissed = field_range::kMostMissed;
  return std::make_tuple(
      SubmapField<&Info::id>{{"submap_id", 1, 1}},
      SubmapField<&Info::panoptic>{{"panoptic", 1, 2, kLabels, kOwn, 0, 2}},
      SubmapField<&Info::class_id>{{"class_id", 1, 3, kLabels}},
      SubmapField<&Info::class_is_fixed>{{"class_is_fixed", 1, 4, kLabels}},
      SubmapField<&Info::display_name>{{"display_name", 1, 16, kName}},
      SubmapField<&Info::T_map_submap>{{"pose", 1, 17, kPose}},
      SubmapField<&Info::voxel_size_m>{{"voxel_size_m", 1, 19}},
      SubmapField<&Info::truncation_m>{{"truncation_m", 1, 20}},
      SubmapField<&Info::class_counts>{{"class_counts", 1, 22, kObservation}},
      SubmapField<&Info::instance_confidence>{{"instance_confidence", 1, 21, kObservation, kUnlessChanged, 0, 1}},
      SubmapField<&Info::activity>{{"activity", 1, 5, kActivity, kUnlessChanged, 0, 1}},
      SubmapField<&Info::is_confirmed>{{"is_confirmed", 1, 6, kActivity, kUnlessChanged}},
      SubmapField<&Info::num_frames_observed>{{"num_frames_observed", 1, 7, kObservation, kOwn, 0, kMost}},
      SubmapField<&Info::num_frames_missed>{{"num_frames_missed", 1, 8, {}, kUnlessChanged, 0, kMissed}},
      SubmapField<&Info::num_frames_overlooked>{{"num_frames_overlooked", 1, 9, {}, kUnlessChanged, 0, kMissed}},
      SubmapField<&Info::first_observed_ns>{{"first_observed_ns", 1, 10, kObservation, kUnlessChanged, -kMost, kMost}},
      SubmapField<&Info::last_observed_ns>{{"last_observed_ns", 1, 11, kObservation, kUnlessChanged, -kMost, kMost}},
      SubmapField<&Info::presence>{{"presence", 2, 24, kActivity, kUnlessChanged, 0, 1}},
      SubmapField<&Info::last_contradicted_ns>{
          {"last_contradicted_ns", 2, 25, kObservation, kUnlessChanged, -kMost, kMost}},
      SubmapField<&Info::is_placed>{{"is_placed", 2, 26, kPose}},
      SubmapField<&Info::track_id>{{"track_id", 1, 12, {}, kUnlessChanged}},
      SubmapField<&Info::revision>{{"revision", 1, 13}},
      SubmapField<&Info::edited_revision>{{"edited_revision", 3, 28, {}, kOwn, 0, kMost}},
      SubmapField<&Info::sightings>{{"sightings", 4, 29, {}, kUnlessChanged}},
      SubmapField<&Info::is_locked>{{"is_locked", 5, 30, kLock}});
}();

/// Calls visit(field) for each, in the order of the list; field.Of(info) is its value.
template <typename Visitor>
constexpr void VisitSubmapFields(Visitor&& visit) {
  std::apply([&visit](const auto&... field) { (visit(field), ...); }, kSubmapFields);
}

/// Whether two values of a field are the same.
template <typename Value>
bool IsSameValue(const Value& a, const Value& b) {
  return a == b;
}
inline bool IsSameValue(const Transform& a, const Transform& b) { return a.matrix() == b.matrix(); }

}  // namespace dhpmap
