// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/relation_score.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/scenes.h"

namespace dhpmap::evaluator {
namespace {

constexpr RelationKind kOn = RelationKind::kOn, kNextTo = RelationKind::kNextTo;

TEST(RelationTruth, IsReadFromTruthJsonWithoutWhatMapsDoNotTell) {
  const dhpmap::testing::TempDir folder;
  const std::string path = folder.path() / "truth.json";
  std::ofstream(path) << R"([{"id": 2, "name": "floor_001", "relations": []},
    {"id": 5, "name": "chair_001", "relations": [{"kind": "ON", "object": 2, "support": 1.0},
                                                 {"kind": "NEXT_TO", "object": 3, "gap_m": 0.1}]},
    {"id": 3, "name": "picture_001", "relations": [{"kind": "HANGS_ON", "object": 1}]}])";
  const auto truth = ReadRelationTruth(path);
  ASSERT_TRUE(truth.ok()) << truth.status().ToString();
  EXPECT_EQ(truth->relations, (std::set<NamedRelation>{{kOn, 5, 2}, {kNextTo, 3, 5}}));
  EXPECT_EQ(truth->names.at(5), "chair_001");
}

TEST(RelationTruth, SaysWhatIsWrongWithAFile) {
  const dhpmap::testing::TempDir folder;
  const std::string path = folder.path() / "truth.json";
  EXPECT_EQ(ReadRelationTruth(path).status().code(), StatusCode::kNotFound);
  for (const char* text : {"", "[", "[{\"id\": 1, \"name\": \"old\"}]", "[]"}) {
    std::ofstream(path) << text;
    EXPECT_EQ(ReadRelationTruth(path).status().code(), StatusCode::kInvalidArgument) << text;
  }
}

TEST(MatchByPlaces, PairsWhatSharesMoreThanHalfOfBoth) {
  const SharedPlaces shared = {{{1, 11}, 60}, {{1, 0}, 40},   // 60 % of the truth, all of the map's
                               {{2, 12}, 50}, {{2, 13}, 50},  // halves
                               {{3, 14}, 90}, {{4, 14}, 95},  // one of two
                               {{0, 15}, 99}};                // of nothing
  EXPECT_EQ(MatchByPlaces(shared), (std::map<std::uint32_t, std::uint32_t>{{11, 1}, {14, 4}}));
}

TEST(ScoreRelations, CountsWhatIsRightWrongAndMissed) {
  RelationTruth truth;
  truth.relations = {{kOn, 1, 2}, {kOn, 3, 2}, {kOn, 4, 2}, {kNextTo, 1, 3}};
  truth.names = {{1, "cup"}, {2, "table"}, {3, "vase"}, {4, "book"}};
  const std::map<std::uint32_t, std::uint32_t> stands_for = {{11, 1}, {12, 2}, {13, 3}};
  const std::vector<NamedRelation> told = {
      {kOn, 11, 12}, {kOn, 12, 11}, {kOn, 99, 12}, MakeNamedRelation(kNextTo, 13, 11)};
  std::vector<std::string> mistakes;
  const auto all = ScoreRelations(truth, told, stands_for, false, &mistakes);
  EXPECT_EQ(all.at(kOn).num_right, 1);
  EXPECT_EQ(all.at(kOn).num_wrong, 2) << "one of them of what stands for nothing";
  EXPECT_EQ(all.at(kOn).num_missed, 2) << "one of them of what nothing stands for";
  EXPECT_DOUBLE_EQ(all.at(kOn).Precision(), 1.0 / 3);
  EXPECT_EQ(all.at(kNextTo).num_right, 1) << "whichever comes first";
  EXPECT_DOUBLE_EQ(all.at(kNextTo).Recall(), 1);
  EXPECT_EQ(mistakes, (std::vector<std::string>{"wrong: table ON cup", "wrong: submap 99 ON table",
                                                "missed: vase ON table", "missed: book ON table"}));
  const auto matched = ScoreRelations(truth, told, stands_for, true, nullptr);
  EXPECT_EQ(matched.at(kOn).num_wrong, 1);
  EXPECT_EQ(matched.at(kOn).num_missed, 1);
}

}  // namespace
}  // namespace dhpmap::evaluator
