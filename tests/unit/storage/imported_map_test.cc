// SPDX-License-Identifier: BSD-3-Clause
// What whoever forges the file of a map, with right checksums, cannot make a server take.
#include "storage/files/imported_map.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "storage/rows/map_rows.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

using testing::SqliteStoreTest;

struct ReadBack {
  MapInfo info;
  std::vector<SubmapRow> submaps;
};

/// What a forger makes of a good map, and the field that is complained of.
struct Forgery {
  const char* field;
  void (*alter)(ReadBack& map);
};

Sighting SightingOf(const std::string& session, std::int32_t num_frames_missed) {
  Sighting sighting;
  sighting.session = session;
  sighting.track_id = 1;
  sighting.num_frames_missed = num_frames_missed;
  return sighting;
}

const std::vector<Forgery>& ForgedMaps() {
  static const std::vector<Forgery> forged = {
      {"name", [](ReadBack& map) { map.info.name = "../etc"; }},
      {"display_name", [](ReadBack& map) { map.info.display_name = std::string(257, 'a'); }},
      {"display_name", [](ReadBack& map) { map.info.display_name = "\xFF"; }},
      {"revision", [](ReadBack& map) { map.info.revision = -1; }},
      {"revision", [](ReadBack& map) { map.info.revision = std::numeric_limits<std::int64_t>::max(); }},
      {"num_frames", [](ReadBack& map) { map.info.num_frames = std::int64_t{1} << 62; }},
      {"next_submap_id", [](ReadBack& map) { map.info.next_submap_id = SubmapId(0); }},
      {"next_submap_id", [](ReadBack& map) { map.info.next_submap_id = SubmapId(0xFFFF'FFFFu); }},
      {"create_time_ns", [](ReadBack& map) { map.info.create_time_ns = std::int64_t{1} << 62; }},
      {"update_time_ns", [](ReadBack& map) { map.info.update_time_ns = std::numeric_limits<std::int64_t>::min(); }},
      {"sessions[run].time_ns",
       [](ReadBack& map) {
         map.info.sessions.Set({"run", 1, std::numeric_limits<std::int64_t>::max()});
       }},
      {"config.voxel_size_m", [](ReadBack& map) { map.info.config.voxel_size_m = 0; }},
      {"config.truncation_m", [](ReadBack& map) { map.info.config.truncation_m = 1; }},
      {"config.refinement.crf_iterations",
       [](ReadBack& map) { map.info.config.refinement.crf_iterations = 2'000'000'000; }},
  };
  return forged;
}

/// Of submap 2.
const std::vector<Forgery>& ForgedSubmaps() {
  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  static const std::vector<Forgery> forged = {
      {"panoptic", [](ReadBack& map) { map.submaps[2].info.panoptic = static_cast<Panoptic>(3); }},
      {"activity", [](ReadBack& map) { map.submaps[2].info.activity = static_cast<Activity>(2); }},
      {"presence", [](ReadBack& map) { map.submaps[2].info.presence = static_cast<Presence>(2); }},
      {"instance_confidence", [](ReadBack& map) { map.submaps[2].info.instance_confidence = 1.5f; }},
      {"num_frames_observed", [](ReadBack& map) { map.submaps[2].info.num_frames_observed = -1; }},
      {"num_frames_missed", [](ReadBack& map) { map.submaps[2].info.num_frames_missed = 0x7FFF'FFFF; }},
      {"num_frames_overlooked", [](ReadBack& map) { map.submaps[2].info.num_frames_overlooked = -1; }},
      {"first_observed_ns", [](ReadBack& map) { map.submaps[2].info.first_observed_ns = std::int64_t{1} << 62; }},
      {"last_observed_ns", [](ReadBack& map) { map.submaps[2].info.last_observed_ns = std::int64_t{1} << 62; }},
      {"last_contradicted_ns", [](ReadBack& map) { map.submaps[2].info.last_contradicted_ns = std::int64_t{1} << 62; }},
      {"revision", [](ReadBack& map) { map.submaps[2].info.revision = map.info.revision + 1; }},
      {"edited_revision", [](ReadBack& map) { map.submaps[2].info.edited_revision = -1; }},
      {"voxel_size_m", [](ReadBack& map) { map.submaps[2].info.voxel_size_m = 1e-9; }},
      {"voxel_size_m", [](ReadBack& map) { map.submaps[2].info.voxel_size_m = kNan; }},
      {"truncation_m", [](ReadBack& map) { map.submaps[2].info.truncation_m = 99; }},
      {"pose", [](ReadBack& map) { map.submaps[2].info.T_map_submap.matrix()(0, 3) = kNan; }},
      {"pose", [](ReadBack& map) { map.submaps[2].info.T_map_submap.matrix()(1, 1) += 3; }},
      {"pose", [](ReadBack& map) { map.submaps[2].info.T_map_submap.matrix()(2, 3) = 1e12; }},
      {"sphere", [](ReadBack& map) { map.submaps[2].sphere.radius_m = std::numeric_limits<double>::infinity(); }},
      {"sphere", [](ReadBack& map) { map.submaps[2].sphere.center_m.y() = kNan; }},
      {"class_counts",
       [](ReadBack& map) {
         map.submaps[2].info.class_counts = {{ClassId(9), 1}, {ClassId(1), 1}};
       }},
      {"display_name", [](ReadBack& map) { map.submaps[2].info.display_name = std::string(257, 'a'); }},
      {"sightings",
       [](ReadBack& map) { map.submaps[2].info.sightings = Sightings::Create({SightingOf("a b", 0)}).value(); }},
      {"sightings",
       [](ReadBack& map) {
         map.submaps[2].info.sightings = Sightings::Create({SightingOf("run", 0x7FFF'FFFF)}).value();
       }},
      {"id", [](ReadBack& map) { map.submaps[2].info.id = map.submaps[1].info.id; }},
  };
  return forged;
}

class ImportedMapTest : public SqliteStoreTest {
 protected:
  void SetUp() override {
    Open();
    CreateSample("house");
    auto opened = sqlite::Database::Open(Path(), sqlite::OpenMode::kReadOnly, 1000);
    ASSERT_TRUE(opened.ok());
    database_ = std::move(opened).value();
    auto map = ReadMap(*database_, "house");
    ASSERT_TRUE(map.ok()) << map.status().ToString();
    auto submaps = ReadSubmaps(*database_, map->key);
    ASSERT_TRUE(submaps.ok()) << submaps.status().ToString();
    house_ = {map->info, *submaps};
    ASSERT_EQ(house_.submaps.size(), 4u);
  }

  static void ExpectRefused(const Status& status, const std::string& field) {
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
    EXPECT_EQ(status.reason(), Reason("BAD_MAP"));
    ASSERT_EQ(status.violations().size(), 1u);
    EXPECT_EQ(status.violations()[0].field, field);
    EXPECT_NE(status.message().find(field), std::string::npos) << status.message();
  }
  void ExpectRefused(const Forgery& forgery, const std::string& field) const {
    SCOPED_TRACE(field);
    ReadBack map = house_;
    forgery.alter(map);
    ExpectRefused(ValidateImported(map.info, map.submaps), field);
  }
  void ExpectClassRefused(const LabelClass& label_class, const std::string& field) const {
    ReadBack map = house_;
    auto labels = LabelSet::Create({label_class});
    ASSERT_TRUE(labels.ok());
    map.info.label_set = std::make_shared<const LabelSet>(std::move(labels).value());
    ExpectRefused(ValidateImported(map.info, map.submaps), field);
  }

  ReadBack house_;
  std::optional<sqlite::Database> database_;
};

TEST_F(ImportedMapTest, AMapAsTheStoreHasItIsTaken) {
  const Status status = ValidateImported(house_.info, house_.submaps);
  EXPECT_TRUE(status.ok()) << status.ToString();
  EXPECT_TRUE(CheckRowCounts(*database_).ok());
  EXPECT_TRUE(CheckTileIndices(*database_).ok());
}

TEST_F(ImportedMapTest, EachFieldOfAMapKeepsToTheRulesThatMapsAreMadeBy) {
  for (const Forgery& forgery : ForgedMaps()) ExpectRefused(forgery, forgery.field);
}

TEST_F(ImportedMapTest, EachFieldOfASubmapKeepsToTheRulesThatSubmapsAreMadeBy) {
  for (const Forgery& forgery : ForgedSubmaps()) {
    const bool is_id = std::string(forgery.field) == "id";  // that of another then
    ExpectRefused(forgery, std::string(is_id ? "submaps[1]." : "submaps[2].") + forgery.field);
  }
}

TEST_F(ImportedMapTest, TheNextSubmapGetsAnIdThatNoneHas) {
  house_.info.next_submap_id = house_.submaps.back().info.id;
  ExpectRefused(ValidateImported(house_.info, house_.submaps), "submaps[3].id");
}

TEST_F(ImportedMapTest, ClassesAreOfAKindAndASizeAndCanBeToldOf) {
  ExpectClassRefused({ClassId(5), "sofa", static_cast<Panoptic>(7), SizeClass::kSmall, {}},
                     "label_classes[5].panoptic");
  ExpectClassRefused({ClassId(5), "sofa", Panoptic::kThing, static_cast<SizeClass>(3), {}}, "label_classes[5].size");
  ExpectClassRefused({ClassId(5), "so\xC3", Panoptic::kThing, SizeClass::kSmall, {}}, "label_classes[5].name");
  ExpectClassRefused({ClassId(5), std::string(2 << 20, 'a'), Panoptic::kThing, SizeClass::kSmall, {}},
                     "label_classes[5].name");
}

TEST_F(ImportedMapTest, MoreRowsThanAMapMayHaveAreRefusedWithoutReadingThem) {
  ExpectRefused(CheckRowCounts(*database_, {.num_maps = 0}), "maps");
  ExpectRefused(CheckRowCounts(*database_, {.num_submaps = 3}), "submaps");
  ExpectRefused(CheckRowCounts(*database_, {.num_classes = 1}), "classes");
  ExpectRefused(CheckRowCounts(*database_, {.num_config_keys = 5}), "config keys");
  ExpectRefused(CheckRowCounts(*database_, {.num_sessions = 1}), "sessions");
  ExpectRefused(CheckRowCounts(*database_, {.num_merged_ids = 1}), "merged submaps");
  ExpectRefused(CheckRowCounts(*database_, {.num_pairs = 1}), "pairs of submaps");
  ExpectRefused(CheckRowCounts(*database_, {.num_tiles = 2}), "tiles");
  EXPECT_TRUE(CheckRowCounts(*database_, {.num_submaps = 4, .num_classes = 2, .num_sessions = 2}).ok());
}

TEST_F(ImportedMapTest, TilesBeyondTheGridAreRefused) {
  Tamper("UPDATE tiles SET y = y + 67108864 WHERE layer = 1");
  ExpectRefused(CheckTileIndices(*database_), "tiles");
}

}  // namespace
}  // namespace dhpmap
