// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/edits/edit_list.h"

#include <gtest/gtest.h>

#include <random>

#include "server/app/states/etag.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

std::string_view NameOfReason(const Status& status) { return status.reason().name(); }

/// A map whose things are rows of blocks along x, each at its own y.
class EditListTest : public ::testing::Test {
 protected:
  EditListTest() {
    for (int n = 0; n < 4; ++n) things_.push_back(AddRow(n));
    map_.Publish(1);
  }

  SubmapId AddRow(int n) {
    SubmapInfo info;
    info.panoptic = Panoptic::kThing;
    info.class_id = ClassId(1);
    info.voxel_size_m = map_.info().config.voxel_size_m;
    info.truncation_m = map_.info().config.truncation_m;
    info.activity = Activity::kInactive;
    Submap& submap = map_.Create(std::move(info));
    for (int x = 0; x < 3; ++x) {
      for (int i = 0; i < kBlockVoxels; ++i) {
        submap.MutableTsdf({x, n, 0}).weight[static_cast<std::size_t>(i)] = 1.0f + static_cast<float>(i % 3);
        submap.MutableLabels({x, n, 0}).AddObservation(i, ClassId(1));
      }
    }
    submap.AddClassObservations(ClassId(1), 3 * kBlockVoxels);
    submap.UpdateBoundingSphere();
    return submap.id();
  }

  static MapInfo Info() {
    MapInfo info;
    info.name = "m";
    info.label_set = testing::MakeLabelSet(3, 1);
    return info;
  }
  [[nodiscard]] double block_m() const { return kBlockSide * map_.info().config.voxel_size_m; }

  static Edit On(EditTarget target, decltype(Edit::action) action) {
    return {.target = target, .etag = {}, .action = std::move(action)};
  }
  static PatchEdit Rename(const std::string& name) {
    SubmapPatch patch;
    patch.display_name = name;
    return {patch};
  }
  [[nodiscard]] SplitEdit SplitAfterBlocks(int n) const {
    return {SplitByPlane{Eigen::Vector3d(n * block_m(), 0, 0), Eigen::Vector3d(2, 0, 0)}};
  }

  Map map_{Info()};
  std::vector<SubmapId> things_;
};

TEST_F(EditListTest, LaterEditsApplyToTheResultsOfEarlierOnes) {
  EditList list;
  list.edits.push_back(On(things_[0], CloneEdit{}));
  list.edits.push_back(On(EarlierResult{0}, SplitAfterBlocks(1)));
  list.edits.push_back(On(EarlierResult{1}, Rename("right")));
  list.edits.push_back(On(EarlierResult{0}, MergeEdit{{EarlierResult{1}}}));
  const auto results = ApplyEdits(list, map_);
  ASSERT_TRUE(results.ok()) << results.status().ToString();
  ASSERT_EQ(results->size(), 4u);
  const SubmapId copy = results->at(0).created.at(0), part = results->at(1).created.at(0);
  EXPECT_EQ(results->at(1).num_voxels, 2 * kBlockVoxels);
  EXPECT_EQ(results->at(3).changed, std::vector<SubmapId>{copy});
  EXPECT_EQ(results->at(3).removed, std::vector<SubmapId>{part});
  EXPECT_EQ(map_.info().merged.Into(part), copy);
  EXPECT_EQ(map_.Find(copy)->blocks().size(), 3u);
  EXPECT_EQ(map_.Find(copy)->info().display_name, "right");
}

TEST_F(EditListTest, AnErrorNamesItsEdit) {
  EditList list;
  list.edits.push_back(On(things_[0], DeleteEdit{}));
  list.edits.push_back(On(things_[0], Rename("gone")));
  const auto results = ApplyEdits(list, map_);
  EXPECT_EQ(results.status().code(), StatusCode::kNotFound);
  EXPECT_TRUE(results.status().message().starts_with("edits[1]: ")) << results.status().message();
}

TEST_F(EditListTest, AnErrorNamesTheSuccessorMergedInTheList) {
  EditList list;
  list.edits.push_back(On(things_[0], MergeEdit{{things_[1]}}));
  list.edits.push_back(On(things_[1], Rename("part")));
  const auto results = ApplyEdits(list, map_);
  EXPECT_EQ(NameOfReason(results.status()), "MERGED_INTO");
  ASSERT_EQ(results.status().metadata().size(), 1u);
  EXPECT_EQ(results.status().metadata()[0].second, "maps/m/submaps/" + std::to_string(things_[0].value));
}

TEST_F(EditListTest, EtagsReferToTheStateBeforeTheList) {
  const std::string etag = EtagOf(*map_.Find(things_[0]), map_.info());
  EditList list;
  for (int i = 0; i < 2; ++i) {
    list.edits.push_back(On(things_[0], Rename("n" + std::to_string(i))));
    list.edits.back().etag = etag;
  }
  EXPECT_TRUE(ApplyEdits(list, map_).ok());
  map_.Publish(2);
  EXPECT_EQ(NameOfReason(ApplyEdits(list, map_).status()), "ETAG_MISMATCH");
}

TEST_F(EditListTest, ExpectedRevisionsCompareEditsAndNotFrames) {
  const std::int64_t known = map_.info().revision;
  map_.FindMutable(things_[0])->MutableTsdf({0, 0, 0}).weight[0] = 9;  // as a frame does
  map_.Publish(2);
  EditList list{.edits = {}, .expected_revision = known};
  list.edits.push_back(On(things_[0], Rename("first")));
  ASSERT_TRUE(ApplyEdits(list, map_).ok());
  map_.Publish(3);
  EXPECT_EQ(NameOfReason(ApplyEdits(list, map_).status()), "EDITED_SINCE");
  list.edits[0].target = things_[1];
  EXPECT_TRUE(ApplyEdits(list, map_).ok()) << "another object was edited, not this one";
  list.edits.push_back(On(things_[1], Rename("twice in one list")));
  map_.Publish(4);
  list.expected_revision = map_.info().revision;
  EXPECT_TRUE(ApplyEdits(list, map_).ok());
  list.expected_revision = map_.info().revision + 10;
  EXPECT_EQ(NameOfReason(ApplyEdits(list, map_).status()), "EDITED_SINCE");
}

TEST_F(EditListTest, EtagsCompareEditsAndNotFrames) {
  EditList list;
  list.edits.push_back(On(things_[0], Rename("first")));
  list.edits[0].etag = EtagOf(*map_.Find(things_[0]), map_.info());
  map_.FindMutable(things_[0])->MutableTsdf({0, 0, 0}).weight[0] = 9;  // as a frame does
  map_.Publish(2);
  ASSERT_TRUE(ApplyEdits(list, map_).ok());
  map_.Publish(3);
  EXPECT_EQ(NameOfReason(ApplyEdits(list, map_).status()), "ETAG_MISMATCH");
  list.edits[0].etag = EtagOf(*map_.Find(things_[1]), map_.info());
  EXPECT_EQ(NameOfReason(ApplyEdits(list, map_).status()), "ETAG_MISMATCH") << "of another object";
}

TEST_F(EditListTest, AnObjectClearedByTheListIsComparedAsBeforeTheList) {
  const std::int64_t known = map_.info().revision;
  const std::string etag = EtagOf(*map_.Find(things_[0]), map_.info());
  ASSERT_TRUE(ApplyEdits({.edits = {On(things_[0], Rename("of another client"))}}, map_).ok());
  map_.Publish(2);
  const BoundingSphere corner{Eigen::Vector3d::Zero(), 0.3 * block_m()};
  EditList list{.edits = {}, .expected_revision = known};
  list.edits.push_back({.target = {}, .etag = {}, .action = ClearEdit{corner, {}}});
  list.edits.push_back(On(things_[0], Rename("mine")));
  EXPECT_EQ(NameOfReason(ApplyEdits(list, map_).status()), "EDITED_SINCE");
  map_ = Map(map_.published());
  list.expected_revision = 0;
  list.edits[1].etag = etag;
  EXPECT_EQ(NameOfReason(ApplyEdits(list, map_).status()), "ETAG_MISMATCH");
  map_ = Map(map_.published());
  list.edits[1].etag = EtagOf(*map_.Find(things_[0]), map_.info());
  EXPECT_TRUE(ApplyEdits(list, map_).ok());
}

TEST_F(EditListTest, LostRevisionsAndTheirEtagsAreRefused) {
  const std::int64_t lost = map_.info().revision;
  EditList list{.edits = {}, .expected_revision = lost, .lost = {{lost, lost}}};
  list.edits.push_back(On(things_[0], Rename("x")));
  const std::string etag = EtagOf(*map_.Find(things_[0]), map_.info());
  map_.FindMutable(things_[0])->MutableTsdf({0, 0, 0}).weight[0] = 9;
  map_.Publish(2);
  const Status refused = ApplyEdits(list, map_).status();
  EXPECT_EQ(refused.code(), StatusCode::kOutOfRange);
  EXPECT_EQ(NameOfReason(refused), "HISTORY_LOST");
  list.expected_revision = 0;
  list.edits[0].etag = etag;
  EXPECT_EQ(NameOfReason(ApplyEdits(list, map_).status()), "ETAG_MISMATCH");
  list.expected_revision = map_.info().revision;
  list.edits[0].etag = EtagOf(*map_.Find(things_[0]), map_.info());
  EXPECT_TRUE(ApplyEdits(list, map_).ok());
}

TEST_F(EditListTest, EditsWithoutEffectMakeNoRevision) {
  SubmapPatch patch{.T_map_submap = Transform(Eigen::Translation3d(0, 0, 1)), .class_id = ClassId(1)};
  patch.is_locked = true;
  EditList list;
  list.edits = {On(things_[0], PatchEdit{patch}), On(things_[1], PresenceEdit{Presence::kAbsent}),
                On(things_[2], Rename(""))};
  const auto first = ApplyEdits(list, map_);
  ASSERT_TRUE(first.ok()) << first.status().ToString();
  EXPECT_EQ(first->at(0).changed, std::vector<SubmapId>{things_[0]});
  EXPECT_EQ(first->at(1).changed, std::vector<SubmapId>{things_[1]});
  EXPECT_EQ(first->at(2).changed, std::vector<SubmapId>{}) << "it follows its class already";
  const auto before = map_.Publish(2);
  list.edits.push_back(On(things_[3], PresenceEdit{Presence::kPresent}));
  const auto again = ApplyEdits(list, map_);
  ASSERT_TRUE(again.ok());
  for (const EditResult& result : *again) EXPECT_TRUE(result.changed.empty());
  EXPECT_EQ(map_.Publish(3), before);
}

TEST_F(EditListTest, AMergeCountsAsAnEditOfTheRemainingObject) {
  const std::int64_t known = map_.info().revision;
  EditList merge;
  merge.edits.push_back(On(things_[0], MergeEdit{{things_[1]}}));
  ASSERT_TRUE(ApplyEdits(merge, map_).ok());
  map_.Publish(2);
  EditList list{.edits = {}, .expected_revision = known};
  list.edits.push_back(On(things_[0], Rename("x")));
  EXPECT_EQ(NameOfReason(ApplyEdits(list, map_).status()), "EDITED_SINCE");
}

TEST_F(EditListTest, MeaninglessEditsAreRefused) {
  const auto reason_of = [this](Edit edit) {
    EditList list;
    list.edits.push_back(std::move(edit));
    return NameOfReason(ApplyEdits(list, map_).status());
  };
  EXPECT_EQ(NameOfReason(ApplyEdits({}, map_).status()), "BAD_EDIT");
  EXPECT_EQ(reason_of(On(EarlierResult{0}, DeleteEdit{})), "BAD_EDIT");
  EXPECT_EQ(reason_of({.target = {}, .etag = {}, .action = DeleteEdit{}}), "BAD_EDIT");
  EXPECT_EQ(reason_of(On(things_[0], MergeEdit{})), "BAD_EDIT");
  EXPECT_EQ(reason_of(On(things_[0], MergeEdit{{things_[0]}})), "NOT_MERGEABLE");
  EXPECT_EQ(reason_of(On(kUnknownSubmap, DeleteEdit{})), "UNKNOWN_SUBMAP");
  EXPECT_EQ(reason_of(On(SubmapId(999), DeleteEdit{})), "SUBMAP_NOT_FOUND");
  EXPECT_EQ(reason_of(On(things_[0], SplitAfterBlocks(9))), "NOTHING_TO_SPLIT");
  EXPECT_EQ(reason_of(On(things_[0], SplitEdit{SplitByParts{}})), "NOTHING_TO_SPLIT");
}

TEST_F(EditListTest, ABackgroundCannotBeAbsentOrSplitWithoutAClass) {
  SubmapInfo info;
  info.panoptic = Panoptic::kStuff;
  info.class_id = ClassId(4);
  info.voxel_size_m = map_.info().config.voxel_size_m;
  const SubmapId floor = map_.Create(std::move(info)).id();
  for (const decltype(Edit::action)& action : {decltype(Edit::action)(SplitAfterBlocks(1)), {PresenceEdit{}}}) {
    EditList list;
    list.edits.push_back(On(floor, action));
    EXPECT_EQ(NameOfReason(ApplyEdits(list, map_).status()), "NOT_A_THING");
  }
}

TEST_F(EditListTest, ABackgroundIsSplitIntoThingsOfTheGivenClass) {
  const SubmapId door = things_[0];
  SubmapInfo& info = map_.FindMutable(door)->mutable_info();
  info.panoptic = Panoptic::kStuff;
  info.class_id = ClassId(4);
  const auto apply = [&](const std::optional<ClassId>& class_id) {
    SplitEdit split = SplitAfterBlocks(1);
    split.class_id = class_id;
    EditList list;
    list.edits.push_back(On(door, split));
    return ApplyEdits(list, map_);
  };
  EXPECT_EQ(NameOfReason(apply(std::nullopt).status()), "NOT_A_THING");
  EXPECT_NE(apply(std::nullopt).status().message().find("class_name"), std::string::npos);
  for (const ClassId bad : {ClassId(4), ClassId(99)}) {
    const Status status = apply(bad).status();
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
    ASSERT_EQ(status.violations().size(), 1u);
    EXPECT_EQ(status.violations()[0].field, "edits[0].split.class_name");
  }
  EXPECT_EQ(map_.submaps().size(), things_.size() + 1) << "and the unknown submap: nothing was done";

  const auto results = apply(ClassId(2));
  ASSERT_TRUE(results.ok()) << results.status().ToString();
  EXPECT_EQ(results->at(0).changed, std::vector<SubmapId>{door});
  EXPECT_EQ(results->at(0).num_voxels, 2 * kBlockVoxels);
  const SubmapInfo& part = map_.Find(results->at(0).created.at(0))->info();
  EXPECT_EQ(part.panoptic, Panoptic::kThing);
  EXPECT_EQ(part.class_id, ClassId(2));
  EXPECT_TRUE(part.class_is_fixed);
  EXPECT_EQ(map_.Find(door)->info().panoptic, Panoptic::kStuff);
  EXPECT_EQ(map_.Find(door)->info().class_id, ClassId(4));
  EXPECT_TRUE(map_.info().pairs.Of(door, part.id).AreTwo());
}

TEST_F(EditListTest, PartsOfAThingKeepItsClassUnlessAnotherIsGiven) {
  EditList list;
  list.edits.push_back(On(things_[0], SplitAfterBlocks(1)));
  SplitEdit other = SplitAfterBlocks(1);
  other.class_id = ClassId(3);
  list.edits.push_back(On(things_[1], other));
  const auto results = ApplyEdits(list, map_);
  ASSERT_TRUE(results.ok()) << results.status().ToString();
  EXPECT_EQ(map_.Find(results->at(0).created.at(0))->info().class_id, ClassId(1));
  EXPECT_FALSE(map_.Find(results->at(0).created.at(0))->info().class_is_fixed);
  EXPECT_EQ(map_.Find(results->at(1).created.at(0))->info().class_id, ClassId(3));
  EXPECT_TRUE(map_.Find(results->at(1).created.at(0))->info().class_is_fixed);
}

TEST_F(EditListTest, AnObjectSetAbsentStaysSoUntilAnotherEdit) {
  EditList list;
  list.edits.push_back(On(things_[0], PresenceEdit{Presence::kAbsent}));
  ASSERT_TRUE(ApplyEdits(list, map_).ok());
  EXPECT_TRUE(map_.Find(things_[0])->IsAbsent());
  list.edits[0].action = PresenceEdit{Presence::kPresent};
  ASSERT_TRUE(ApplyEdits(list, map_).ok());
  EXPECT_FALSE(map_.Find(things_[0])->IsAbsent());
}

TEST_F(EditListTest, ALockedObjectCanBeEditedAndItsPartsAreLocked) {
  const auto apply = [this](Edit edit) {
    auto results = ApplyEdits({.edits = {std::move(edit)}}, map_);
    EXPECT_TRUE(results.ok()) << results.status().ToString();
    return results.ok() ? results->front() : EditResult();
  };
  SubmapPatch lock;
  lock.is_locked = true;
  apply(On(things_[0], PatchEdit{lock}));
  const auto is_locked = [this](SubmapId id) { return map_.Find(id)->info().is_locked; };
  ASSERT_TRUE(is_locked(things_[0]));
  apply(On(things_[0], Rename("mine")));
  EXPECT_EQ(map_.Find(things_[0])->info().display_name, "mine");
  EXPECT_FALSE(is_locked(apply(On(things_[0], CloneEdit{})).created[0]));
  EXPECT_TRUE(is_locked(apply(On(things_[0], SplitAfterBlocks(1))).created[0])) << "its voxels stay left alone";
  apply(On(things_[1], MergeEdit{{things_[0]}}));
  EXPECT_TRUE(is_locked(things_[1])) << "its voxels stay left alone";
  apply(On(things_[1], DeleteEdit{}));
  EXPECT_EQ(map_.Find(things_[1]), nullptr);
}

TEST_F(EditListTest, RegionsAreIgnoredUpToALimitAndRemoved) {
  const auto reason_of = [this](decltype(Edit::action) action) {
    return NameOfReason(
        ApplyEdits({.edits = {{.target = {}, .etag = {}, .action = std::move(action)}}}, map_).status());
  };
  const BoundingSphere sphere{Eigen::Vector3d::Zero(), 1.0};
  const auto keep = [&](const std::string& name) { return reason_of(KeepClearEdit{{name, sphere}}); };
  for (int i = 0; i < 64; ++i) EXPECT_EQ(keep("r" + std::to_string(i)), "");
  EXPECT_EQ(keep("r64"), "TOO_MANY_IGNORED_REGIONS");
  EXPECT_EQ(keep("r1"), "IGNORED_REGION_EXISTS");
  EXPECT_EQ(reason_of(ClearEdit{sphere, {}, "r64"}), "TOO_MANY_IGNORED_REGIONS");
  EXPECT_EQ(reason_of(LiftEdit{"r64"}), "IGNORED_REGION_NOT_FOUND");
  EXPECT_EQ(reason_of(LiftEdit{"r7"}), "");
  EXPECT_EQ(keep("Not a name"), "BAD_EDIT");
  EXPECT_EQ(reason_of(KeepClearEdit{{"far", BoundingSphere{Eigen::Vector3d(1e10, 0, 0), 1}}}), "BAD_EDIT");
  EXPECT_EQ(reason_of(ClearEdit{sphere, {}, "r7"}), "");
  EXPECT_EQ(map_.info().kept_clear.list().size(), 64u);
}

TEST_F(EditListTest, ARegionIsClearedOfAllObjectsOrOfOne) {
  const BoundingSphere everything{Eigen::Vector3d::Zero(), 100.0};
  EditList list;
  list.edits.push_back(On(things_[1], ClearEdit{everything, {}}));
  auto results = ApplyEdits(list, map_);
  ASSERT_TRUE(results.ok());
  EXPECT_EQ(results->at(0).removed, std::vector<SubmapId>{things_[1]});
  EXPECT_EQ(results->at(0).num_voxels, 3 * kBlockVoxels);
  list.edits[0] = {.target = {}, .etag = {}, .action = ClearEdit{everything, {ClassId(2)}}};
  results = ApplyEdits(list, map_);
  ASSERT_TRUE(results.ok());
  EXPECT_EQ(results->at(0).num_voxels, 0);
  list.edits[0] = {.target = {}, .etag = {}, .action = ClearEdit{everything, {}}};
  results = ApplyEdits(list, map_);
  ASSERT_TRUE(results.ok());
  EXPECT_EQ(results->at(0).removed.size(), 3u);
}

/// Sum of the observed weights of all things.
double TotalWeight(const Map& map) {
  double total = 0;
  for (const auto& submap : map.submaps()) {
    for (const BlockEntry& entry : submap->blocks().entries()) {
      for (const float weight : entry.tsdf->weight) total += weight;
    }
  }
  return total;
}

TEST_F(EditListTest, RandomSplitsAndMergesLoseNoObservation) {
  const double total = TotalWeight(map_);
  const std::size_t num_things = things_.size();
  std::mt19937 random(3);
  std::vector<std::pair<SubmapId, SubmapId>> split;  // what was cut off, and from what
  for (int step = 0; step < 60; ++step) {
    EditList list;
    if (split.empty() || random() % 2 == 0) {
      const SubmapId of = things_[random() % things_.size()];
      const double at_m = block_m() * (0.2 + 2.6 * static_cast<double>(random() % 1000) / 1000);
      list.edits.push_back(On(of, SplitEdit{SplitByPlane{Eigen::Vector3d(at_m, 0, 0), Eigen::Vector3d::UnitX()}}));
      const auto results = ApplyEdits(list, map_);
      if (results.ok()) split.emplace_back(results->at(0).created.at(0), of);
      else EXPECT_EQ(NameOfReason(results.status()), "NOTHING_TO_SPLIT");
    } else {
      const auto [part, of] = split.back();
      split.pop_back();
      list.edits.push_back(On(of, MergeEdit{{part}}));
      ASSERT_TRUE(ApplyEdits(list, map_).ok());
    }
    EXPECT_NEAR(TotalWeight(map_), total, 1e-6 * total);
    if (step % 7 == 0) map_.Publish(step);
  }
  while (!split.empty()) {
    EditList list;
    list.edits.push_back(On(split.back().second, MergeEdit{{split.back().first}}));
    ASSERT_TRUE(ApplyEdits(list, map_).ok());
    split.pop_back();
  }
  EXPECT_EQ(map_.submaps().size(), num_things + 1);
  for (const SubmapId id : things_) {
    ASSERT_EQ(map_.Find(id)->info().class_counts.size(), 1u);
    EXPECT_EQ(map_.Find(id)->info().class_counts[0].count, 3u * kBlockVoxels);
  }
}

}  // namespace
}  // namespace dhpmap
