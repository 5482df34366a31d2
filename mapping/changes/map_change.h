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

// The difference between two states of a map as watchers see it: values that outlive both states. Stored, so numbers
// are never reused.

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

/// Properties of a submap that filters of watchers use.
struct SubmapPlace {
  Panoptic panoptic = Panoptic::kUnknown;
  ClassId class_id;
  BoundingSphere sphere;  ///< in the map frame
};

/// Move of an object: axis-aligned boxes in the map frame around its outline (OutlineInMap).
struct PoseBoxes {
  Eigen::AlignedBox3d before_m;  ///< around its present surface at the earlier pose
  Eigen::AlignedBox3d after_m;
};

/// The change of one submap.
struct SubmapEvent {
  ChangeKind kind = ChangeKind::kChanged;
  SubmapParts parts;            ///< of kChanged; none: only its revision
  SubmapInfo info;              ///< present values; of a removed one, the last ones; without `before`, only its id
  BoundingSphere observed;      ///< present SphereOfObservedInMap; empty for a removed submap, too
  std::int64_t num_blocks = 0;  ///< present number
  std::vector<TileBox> tiles;   ///< contain all changes of kGeometry, in its own grid; none for kCreated
  SubmapId into;                ///< of kMerged: the successor
  std::optional<SubmapPlace> before;                   ///< with the sphere around its blocks; none if it is new
  std::optional<PoseBoxes> pose_boxes = std::nullopt;  ///< of kPose, if it has a readable surface
};

enum class RegionEventKind : std::uint8_t { kCleared = 1, kKeptClear = 2, kLifted = 3 };

/// The change of a region of space.
struct RegionEvent {
  RegionEventKind kind = RegionEventKind::kCleared;
  Region region = {};                 ///< of kLifted: its last shape
  std::string name = {};              ///< of kKeptClear and kLifted
  SubmapId submap = {};               ///< of kCleared: the only object that was cleared; the unknown submap for several
  std::vector<ClassId> classes = {};  ///< of kCleared without a submap: the only classes cleared, ascending; empty: all
  std::int64_t num_voxels = 0;        ///< of kCleared: observed voxels that were removed
};

/// The change from one stored state of a map to the next.
struct MapChange {
  std::int64_t first_revision = 0;  ///< the first after the earlier state
  std::int64_t last_revision = 0;   ///< that of the later state; revisions between are merged into one change
  std::int64_t time_ns = 0;         ///< UTC, of the later state
  std::optional<std::string> display_name = std::nullopt;  ///< of the map, if it has changed
  std::vector<SubmapEvent> submaps;                        ///< by ascending id
  std::vector<RegionEvent> regions =
      {};  ///< cleared, in the order of the edits; then no longer ignored, then ignored, by name
};

/// At most this many boxes a submap; beyond, one box around them all.
inline constexpr std::size_t kMaxTileBoxes = 32;

/// `submaps` is DiffTiles of the two states. `cleared`: regions that cannot be derived from them.
MapChange DescribeChange(const StateMarks& before, const MapSnapshot& after,
                         const std::vector<SubmapTileChange>& submaps, const std::vector<RegionEvent>& cleared = {});

/// Approximate memory.
std::size_t BytesOf(const MapChange& change);

}  // namespace dhpmap
