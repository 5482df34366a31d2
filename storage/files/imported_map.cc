// SPDX-License-Identifier: BSD-3-Clause
#include "storage/files/imported_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

#include "mapping/base/grid.h"
#include "mapping/base/grid_reach.h"
#include "mapping/base/result.h"
#include "mapping/base/transform.h"
#include "mapping/base/utf8.h"
#include "mapping/labels/class_names.h"
#include "mapping/submap/display_name.h"
#include "mapping/submap/submap_fields.h"
#include "mapping/voxels/block_table.h"

namespace dhpmap {
namespace {

using sqlite::Database;

constexpr char kReadImportTask[] = "read the file";

using field_range::kMostMissed;
using field_range::kMostNumber;
/// Limit of the next id, to leave as many for future submaps: ids that overflow would be assigned twice.
constexpr std::uint32_t kMostNextId = std::uint32_t{1} << 31;
/// Voxel indices are signed 32-bit numbers.
constexpr double kMostVoxels = 2147483648.0;
constexpr std::int64_t kTilesToASide = std::int64_t{1} << (31 - kBlockSideLog2 - kTileSideLog2);

Status Bad(const std::string& field, const std::string& why) {
  return InvalidArgument("the map of the file is not usable: " + field + " " + why)
      .WithReason("BAD_MAP")
      .WithViolation(field, why);
}

Status BadSubmap(const SubmapInfo& info, const std::string& field, const std::string& why) {
  return Bad("submaps[" + std::to_string(info.id.value) + "]." + field, why);
}

/// The reason from the error of a rule that names fields.
std::string FirstOf(const Status& refused) {
  return refused.violations().empty() ? refused.message() : refused.violations().front().description;
}

bool IsCount(std::int64_t number) { return number >= 0 && number <= kMostNumber; }
bool IsTime(std::int64_t time_ns) { return time_ns >= -kMostNumber && time_ns <= kMostNumber; }
bool IsMissed(std::int32_t num_frames) { return num_frames >= 0 && num_frames <= kMostMissed; }

struct NamedNumber {
  const char* field;
  bool is_good;
};

/// The reason why a text is not a valid name; empty if it is.
std::string WhyNoName(std::string_view text, std::size_t max_bytes) {
  if (text.size() > max_bytes) return "is longer than " + std::to_string(max_bytes) + " bytes";
  return FindInvalidUtf8(text) == std::string_view::npos ? "" : "is not UTF-8";
}

Status CheckNumbers(const MapInfo& map) {
  const NamedNumber numbers[] = {
      {"revision", IsCount(map.revision)},
      {"num_frames", IsCount(map.num_frames)},
      {"next_submap_id", map.next_submap_id > kUnknownSubmap && map.next_submap_id.value <= kMostNextId},
      {"create_time_ns", IsTime(map.create_time_ns)},
      {"update_time_ns", IsTime(map.update_time_ns)},
  };
  for (const NamedNumber& number : numbers) {
    if (!number.is_good) return Bad(number.field, "is out of range");
  }
  for (const SessionMark& mark : map.sessions.marks()) {
    if (!IsTime(mark.time_ns)) return Bad("sessions[" + mark.session + "].time_ns", "is out of range");
  }
  return Status::Ok();
}

/// Class names of older maps may be invalid for new maps; this only checks that they can be returned.
Status CheckClasses(const LabelSet& label_set) {
  std::size_t num_bytes = 0;
  for (const LabelClass& label_class : label_set.classes()) {
    const std::string field = "label_classes[" + std::to_string(label_class.id.value) + "].";
    if (label_class.panoptic > Panoptic::kStuff) return Bad(field + "panoptic", "is no kind");
    if (label_class.size > SizeClass::kLarge) return Bad(field + "size", "is no size");
    const std::string problem = WhyNoName(label_class.name, kMaxClassNamesBytes);
    if (!problem.empty()) return Bad(field + "name", problem);
    num_bytes += label_class.name.size();
  }
  if (num_bytes <= kMaxClassNamesBytes) return Status::Ok();
  return Bad("label_classes", "take more than " + std::to_string(kMaxClassNamesBytes) + " bytes of names");
}

Status CheckMap(const MapInfo& map) {
  if (!ValidateMapName(map.name).ok()) return Bad("name", "is no name of a map");
  DHPMAP_RETURN_IF_ERROR(CheckNumbers(map));
  const std::string problem = WhyNoName(map.display_name, kMaxDisplayNameBytes);
  if (!problem.empty()) return Bad("display_name", problem);
  const Status config = map.config.Validate();
  if (!config.ok()) return Bad("config." + config.violations().front().field, FirstOf(config));
  return CheckClasses(*map.label_set);
}

/// A submap's grid must satisfy the rules for maps, and may differ from the map's.
Status CheckGrid(const MapConfig& of_map, const SubmapInfo& info) {
  MapConfig config = of_map;
  config.voxel_size_m = info.voxel_size_m;
  config.truncation_m = info.truncation_m;
  const Status valid = config.Validate();
  return valid.ok() ? Status::Ok() : BadSubmap(info, valid.violations().front().field, FirstOf(valid));
}

Status CheckPose(const SubmapInfo& info) {
  const Status rigid = TransformFromMatrix(info.T_map_submap.matrix(), "pose").status();
  if (!rigid.ok()) return BadSubmap(info, "pose", FirstOf(rigid));
  const std::string problem = WhyBeyondGrid(info.T_map_submap.translation(), info.voxel_size_m);
  return problem.empty() ? Status::Ok() : BadSubmap(info, "pose", problem);
}

/// For submaps without blocks, whose sphere the verification of files does not check.
Status CheckSphere(const SubmapRow& row) {
  const double most_m = kMostVoxels * row.info.voxel_size_m;
  const BoundingSphere& sphere = row.sphere;
  const bool is_good = (sphere.center_m.array().abs() <= most_m).all() && sphere.radius_m <= 2 * most_m;  // no NaN
  return is_good ? Status::Ok() : BadSubmap(row.info, "sphere", "is beyond what its grid reaches");
}

template <typename Value>
constexpr bool kIsNumber = std::is_arithmetic_v<Value> || std::is_enum_v<Value>;

/// Checks each number against the limits in the list of fields.
Status CheckSubmapNumbers(const MapInfo& map, const SubmapInfo& info) {
  if (!(info.id < map.next_submap_id)) return BadSubmap(info, "id", "is out of range");
  if (info.revision < 0 || info.revision > map.revision) return BadSubmap(info, "revision", "is out of range");
  Status status = Status::Ok();
  VisitSubmapFields([&](const auto& field) {
    const auto& value = field.Of(info);
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_floating_point_v<Value>) {
      if (field.most == FieldRules().most) return;  // see CheckGrid
      const bool is_good = value >= static_cast<double>(field.least) && value <= static_cast<double>(field.most);
      if (status.ok() && !is_good) status = BadSubmap(info, field.name, "is out of range");
    } else if constexpr (kIsNumber<Value>) {
      const auto number = static_cast<std::int64_t>(value);
      const bool is_good = number >= field.least && number <= field.most;
      if (status.ok() && !is_good) status = BadSubmap(info, field.name, "is out of range");
    }
  });
  return status;
}

Status CheckSightings(const SubmapInfo& info) {
  for (const Sighting& sighting : info.sightings.all()) {
    const bool has_name = sighting.session.empty() || ValidateSessionName(sighting.session).ok();
    if (!has_name) return BadSubmap(info, "sightings", "are of a session that can have no such name");
    if (!IsMissed(sighting.num_frames_missed)) return BadSubmap(info, "sightings", "are out of range");
  }
  return Status::Ok();
}

bool AreAscending(const std::vector<ClassTotal>& counts) {
  return std::adjacent_find(counts.begin(), counts.end(),
                            [](const ClassTotal& a, const ClassTotal& b) { return !(a.id < b.id); }) == counts.end();
}

/// Checks that the outline is within the grid and has no more corners than any outline that mapping made.
Status CheckOutline(const SubmapRow& row) {
  constexpr std::size_t kMostCorners = 4096;
  if (row.outline == nullptr || !row.outline->outline) return Status::Ok();
  const SubmapOutline& outline = *row.outline->outline;
  const double most_m = 4 * kMostVoxels * row.info.voxel_size_m;
  bool is_good = outline.footprint_m.size() <= kMostCorners && (outline.box.center_m.array().abs() <= most_m).all() &&
                 (outline.box.size_m.array() >= 0).all() && (outline.box.size_m.array() <= most_m).all() &&
                 std::abs(outline.support_height_m.value_or(0)) <= most_m;
  for (const Eigen::Vector2d& corner : outline.footprint_m) is_good = is_good && corner.cwiseAbs().maxCoeff() <= most_m;
  return is_good ? Status::Ok() : BadSubmap(row.info, "outline", "is beyond what its grid reaches");
}

Status CheckSubmap(const MapInfo& map, const SubmapRow& row) {
  const SubmapInfo& info = row.info;
  DHPMAP_RETURN_IF_ERROR(CheckSubmapNumbers(map, info));
  DHPMAP_RETURN_IF_ERROR(CheckGrid(map.config, info));
  DHPMAP_RETURN_IF_ERROR(CheckPose(info));
  DHPMAP_RETURN_IF_ERROR(CheckSphere(row));
  DHPMAP_RETURN_IF_ERROR(CheckOutline(row));
  DHPMAP_RETURN_IF_ERROR(CheckSightings(info));
  if (!AreAscending(info.class_counts)) return BadSubmap(info, "class_counts", "are not ascending");
  const std::string problem = WhyNoName(info.display_name, kMaxDisplayNameBytes);
  return problem.empty() ? Status::Ok() : BadSubmap(info, "display_name", problem);
}

struct TableBound {
  const char* table;
  const char* what;  ///< for messages, which do not name tables
  std::int64_t most;
};

std::vector<TableBound> BoundsOfTables(const RowBounds& bounds) {
  return {
      {"maps", "maps", bounds.num_maps},
      {"submaps", "submaps", bounds.num_submaps},
      {"label_classes", "classes", bounds.num_classes},
      {"map_config", "config keys", bounds.num_config_keys},
      {"feed_sessions", "sessions", bounds.num_sessions},
      {"kept_clear", "regions that are kept clear", bounds.num_kept_clear},
      {"merged_ids", "merged submaps", bounds.num_merged_ids},
      {"object_pairs", "pairs of submaps", bounds.num_pairs},
      {"tiles", "tiles", bounds.num_tiles},
      // Rows that verification compares with the tiles in memory.
      {"tile_blobs", "blobs", bounds.num_tiles},
      {"shared_blobs", "shared blobs", bounds.num_tiles},
      {"dead_blobs", "blobs without use", bounds.num_tiles},
      {"edit_tiles", "edited tiles", bounds.num_tiles},
      // Parts of tiles in older files.
      {"tsdf_blocks", "blocks", bounds.num_tiles},
      {"label_blocks", "blocks of labels", bounds.num_tiles},
      {"gone_blocks", "blocks of what is gone", bounds.num_tiles},
      {"map_tiles", "tiles of the map", bounds.num_tiles},
  };
}

}  // namespace

Status CheckRowCounts(Database& file, const RowBounds& bounds) {
  for (const TableBound& bound : BoundsOfTables(bounds)) {
    const std::string table = bound.table;
    DHPMAP_ASSIGN_OR_RETURN(
        const std::int64_t num_tables,
        file.QueryInt("SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name = '" + table + "'",
                      kReadImportTask));
    if (num_tables == 0) continue;  // not in this schema
    DHPMAP_ASSIGN_OR_RETURN(
        const std::int64_t num_rows,
        file.QueryInt("SELECT count(*) FROM (SELECT 1 FROM " + table + " LIMIT " + std::to_string(bound.most + 1) + ")",
                      kReadImportTask));
    if (num_rows > bound.most) {
      return Bad(bound.what, "are more than the " + std::to_string(bound.most) + " that a file may have");
    }
  }
  return Status::Ok();
}

Status CheckTileIndices(Database& file) {
  const std::string beyond =
      " NOT BETWEEN " + std::to_string(-kTilesToASide) + " AND " + std::to_string(kTilesToASide - 1);
  DHPMAP_ASSIGN_OR_RETURN(
      const std::int64_t is_any_beyond,
      file.QueryInt("SELECT EXISTS (SELECT 1 FROM tiles WHERE x" + beyond + " OR y" + beyond + " OR z" + beyond + ")",
                    kReadImportTask));
  return is_any_beyond == 0 ? Status::Ok() : Bad("tiles", "are beyond what the grid reaches");
}

Status ValidateImported(const MapInfo& map, const std::vector<SubmapRow>& submaps) {
  DHPMAP_RETURN_IF_ERROR(CheckMap(map));
  for (std::size_t i = 0; i < submaps.size(); ++i) {
    DHPMAP_RETURN_IF_ERROR(CheckSubmap(map, submaps[i]));
    // The unique index on ids comes from the file and cannot be trusted.
    const bool is_in_order = i == 0 || submaps[i - 1].info.id < submaps[i].info.id;
    if (!is_in_order) return BadSubmap(submaps[i].info, "id", "is there twice");
  }
  return Status::Ok();
}

}  // namespace dhpmap
