// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/class_map.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/scenes.h"

namespace dhpmap::evaluator {
namespace {

namespace fs = std::filesystem;
using dhpmap::testing::SharedDataDir;
using dhpmap::testing::TempDir;

void Write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

LabelClass MakeClass(std::uint16_t id, const std::string& name, Panoptic panoptic = Panoptic::kThing) {
  return {ClassId(id), name, panoptic, SizeClass::kMedium, {}};
}

TEST(ClassMap, ReadsWhatPredictedClassesStandFor) {
  const TempDir dir;
  const fs::path file = dir.path() / "evaluation_classes.csv";
  Write(file, "ClassID,Name,Thing,SemanticKITTI\n1,road,0,40 44 60\n4,wall,0,\n14,car,1,10\n");
  const auto map = ClassMap::Read(file);
  ASSERT_TRUE(map.ok()) << map.status().ToString();
  ASSERT_EQ(map->classes().size(), 2u) << "wall stands for nothing";
  EXPECT_EQ(map->classes()[0], (EvaluatedClass{"road", false, {40, 44, 60}, {1}}));
  EXPECT_EQ(map->classes()[1], (EvaluatedClass{"car", true, {10}, {14}}));
  EXPECT_EQ(map->OfTruth(44), 0);
  EXPECT_EQ(map->OfPrediction(14), 1);
  EXPECT_EQ(map->OfPrediction(4), ClassMap::kNone);
  EXPECT_EQ(map->OfTruth(14), ClassMap::kNone) << "an id of the other side";
}

TEST(ClassMap, NamesFileAndLineOfABadRow) {
  const TempDir dir;
  const fs::path file = dir.path() / "evaluation_classes.csv";
  for (const char* row : {"x,road,0,40", "1,road,2,40", "1,road", "1,road,0,forty", "1,road,0,-4", "70000,road,0,40"}) {
    Write(file, std::string("ClassID,Name,Thing,SemanticKITTI\n14,car,1,10\n") + row + "\n");
    const auto map = ClassMap::Read(file);
    ASSERT_FALSE(map.ok()) << row;
    EXPECT_EQ(map.status().code(), StatusCode::kInvalidArgument);
    EXPECT_NE(map.status().message().find("evaluation_classes.csv"), std::string::npos) << map.status().message();
    EXPECT_NE(map.status().message().find("line 3"), std::string::npos) << map.status().message();
  }
}

TEST(ClassMap, RefusesAnIdInTwoClassesAndAFileWithoutAny) {
  const TempDir dir;
  const fs::path file = dir.path() / "evaluation_classes.csv";
  Write(file, "1,road,0,40\n2,sidewalk,0,40\n");
  EXPECT_NE(ClassMap::Read(file).status().message().find("40"), std::string::npos);
  Write(file, "1,road,0,40\n1,sidewalk,0,48\n");
  EXPECT_FALSE(ClassMap::Read(file).ok());
  Write(file, "1,road,0,\n");
  EXPECT_FALSE(ClassMap::Read(file).ok());
  EXPECT_EQ(ClassMap::Read(dir.path() / "none.csv").status().code(), StatusCode::kNotFound);
}

TEST(FindClassMap, TakesIdsAsTheyAreIfThePredictionHasTheClasses) {
  const TempDir dir;
  Write(dir.path() / "evaluation_classes.csv", "1,road,0,40\n");
  const std::vector<LabelClass> truth{MakeClass(1, "chair"), MakeClass(2, "floor", Panoptic::kStuff)};
  const auto map = FindClassMap(dir.path(), truth, {truth[0], truth[1], MakeClass(3, "lamp")});
  ASSERT_TRUE(map.ok());
  ASSERT_EQ(map->classes().size(), 2u);
  EXPECT_EQ(map->OfPrediction(2), map->OfTruth(2));
  EXPECT_FALSE(map->classes()[1].is_thing);
  EXPECT_EQ(map->OfPrediction(3), ClassMap::kNone);
}

TEST(FindClassMap, LooksBelowAndAboveTheDirectory) {
  const std::vector<LabelClass> truth{MakeClass(40, "road")}, predicted{MakeClass(1, "road")};
  for (const char* place : {"evaluation_classes.csv", "sequences/07/evaluation_classes.csv"}) {
    const TempDir dir;
    Write(dir.path() / place, "1,road,0,40\n");
    const auto map = FindClassMap(dir.path(), truth, predicted);
    ASSERT_TRUE(map.ok()) << place;
    EXPECT_EQ(map->OfTruth(40), map->OfPrediction(1));
  }
  const TempDir dir;
  Write(dir.path() / "evaluation_classes.csv", "1,road,0,40\n");
  fs::create_directories(dir.path() / "sequences" / "07");
  EXPECT_TRUE(FindClassMap(dir.path() / "sequences" / "07", truth, predicted).ok());
}

TEST(FindClassMap, DoesNotGuess) {
  const TempDir dir;
  const auto map = FindClassMap(dir.path(), {MakeClass(40, "road"), MakeClass(48, "sidewalk")}, {MakeClass(1, "road")});
  ASSERT_FALSE(map.ok());
  EXPECT_EQ(map.status().code(), StatusCode::kFailedPrecondition);
  EXPECT_EQ(map.status().reason(), Reason("NO_CLASS_MAP"));
}

TEST(FindClassMap, ReadsTheDevelopersSequences) {
  const fs::path data = SharedDataDir();
  if (data.empty()) GTEST_SKIP() << "no shared data";
  const auto map = ClassMap::Read(data / "kitti" / "sequences" / "07" / "evaluation_classes.csv");
  ASSERT_TRUE(map.ok()) << map.status().ToString();
  EXPECT_EQ(map->OfTruth(71), map->OfPrediction(9)) << "trunks are vegetation";
}

}  // namespace
}  // namespace dhpmap::evaluator
