// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "mapping/changes/state_marks.h"
#include "mapping/map/map.h"
#include "mapping/map/region.h"
#include "mapping/submap/submap_part.h"

namespace dhpmap {

// What is told of the difference between two states of a map to those who follow it: values, which outlive both. Kept
// by the store, so numbers are never reused.

enum class ChangeKind : std::uint8_t { kCreated = 1, kChanged = 2, kRemoved = 3, kMerged = 4 };

/// Value type.
class SubmapParts {
 public:
  constexpr SubmapParts() = default;
  constexpr SubmapParts(std::initializer_list<SubmapPart> parts) {
    for (const SubmapPart part : parts) Add(part);
  }
  static constexpr SubmapParts FromBits(std::uint32_t bits) {
    SubmapParts parts;
    parts.bits_ = bits;
    return parts;
  }
  constexpr void Add(SubmapPart part) { bits_ |= 1u << static_cast<unsigned>(part); }
  [[nodiscard]] constexpr bool Has(SubmapPart part) const { return (bits_ >> static_cast<unsigned>(part) & 1u) != 0; }
  [[nodiscard]] constexpr bool HasAnyOf(SubmapParts others) const { return (bits_ & others.bits_) != 0; }
  [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
  [[nodiscard]] constexpr std::uint32_t bits() const { return bits_; }
  constexpr bool operator==(const SubmapParts&) const = default;

 private:
  std::uint32_t bits_ = 0;
};

/// Tiles from the low to the high corner, both included.
struct TileBox {
  TileIndex low, high;
  constexpr bool operator==(const TileBox&) const = default;
};

/// What of a submap decides whether somebody wants to hear of it.
struct SubmapPlace {
  Panoptic panoptic = Panoptic::kUnknown;
  ClassId class_id;
  BoundingSphere sphere;  ///< in the map frame
};

/// Where an object was put: boxes along the axes of the map frame around its outline (OutlineInMap).
struct PoseBoxes {
  Eigen::AlignedBox3d before_m;  ///< around its present surface at its pose before
  Eigen::AlignedBox3d after_m;
};

/// What became of one submap.
struct SubmapEvent {
  ChangeKind kind = ChangeKind::kChanged;
  SubmapParts parts;                  ///< of kChanged; none: its revision alone
  SubmapInfo info;                    ///< as it is now; of one that is gone, as it was last; without `before`, its id
  BoundingSphere observed;            ///< SphereOfObservedInMap as it is now; empty: of one that is gone, too
  std::int64_t num_blocks = 0;        ///< as it is now
  std::vector<TileBox> tiles;         ///< that hold all changes of kGeometry, in its own grid; none of kCreated
  SubmapId into;                      ///< of kMerged: what it is a part of now
  std::optional<SubmapPlace> before;  ///< with the sphere around its blocks; none of what was not in the state before
  std::optional<PoseBoxes> pose_boxes = std::nullopt;  ///< of kPose, if it has a surface that can be read
};

enum class RegionEventKind : std::uint8_t { kCleared = 1, kKeptClear = 2, kLifted = 3 };

/// What became of a part of space.
struct RegionEvent {
  RegionEventKind kind = RegionEventKind::kCleared;
  Region region = {};                 ///< of kLifted: as it was
  std::string name = {};              ///< of kKeptClear and kLifted
  SubmapId submap = {};               ///< of kCleared: of this one alone; the unknown submap: of more than one
  std::vector<ClassId> classes = {};  ///< of kCleared without a submap: of these alone, by ascending id; empty: of all
  std::int64_t num_voxels = 0;        ///< of kCleared: that were observed and are no more
};

/// What became of a map from one state that was stored to the next.
struct MapChange {
  std::int64_t first_revision = 0;                         ///< the one after the state before
  std::int64_t last_revision = 0;                          ///< of the state after; what was between is told as one
  std::int64_t time_ns = 0;                                ///< UTC, of the state after
  std::optional<std::string> display_name = std::nullopt;  ///< of the map, if that has changed
  std::vector<SubmapEvent> submaps;                        ///< by ascending id
  std::vector<RegionEvent> regions = {};  ///< cleared, in the order of the edits; then lifted, then kept clear, by name
};

/// Of one submap no more than so many; beyond, one box around them all.
inline constexpr std::size_t kMaxTileBoxes = 32;

/// `submaps` is DiffTiles of the two states. `cleared`: what cannot be told from them.
MapChange DescribeChange(const StateMarks& before, const MapSnapshot& after,
                         const std::vector<SubmapTileChange>& submaps, const std::vector<RegionEvent>& cleared = {});

/// In memory, roughly.
std::size_t BytesOf(const MapChange& change);

}  // namespace dhpmap
