// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/kept_outline.h"

#include <gtest/gtest.h>

#include <memory>

#include "mapping/map/map.h"
#include "mapping/submap/submap_outline.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

class KeptOutlineTest : public ::testing::Test {
 protected:
  KeptOutlineTest() {
    Submap& submap = testing::AddThing(map_);
    const Eigen::Vector3d center_m(0.1, 0.2, 0.3);
    testing::ObserveBand(submap, testing::Block(center_m, {0.3, 0.2, 0.25}), testing::CubeAt(center_m, 0.6));
    id_ = submap.id();
    (void)map_.Publish(0);
  }
  Submap& Thing() { return *map_.FindMutable(id_); }
  [[nodiscard]] std::shared_ptr<const LevelOutline> Kept() const {
    const Submap& submap = *map_.Find(id_);
    return submap.kept_outline().Find(submap.info().T_map_submap);
  }

  Map map_{testing::SceneInfo()};
  SubmapId id_;
};

TEST_F(KeptOutlineTest, IsThereOnceItWasFoundAndTheSameOne) {
  EXPECT_EQ(Kept(), nullptr);
  const auto found = FindLevelOutline(*map_.Find(id_));
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(Kept(), found);
  EXPECT_EQ(FindLevelOutline(*map_.Find(id_)), found);
  const auto outline = FindOutline(*map_.Find(id_), Eigen::Matrix3d::Identity());
  ASSERT_TRUE(outline && found->outline);
  EXPECT_EQ(found->outline->box.center_m, outline->box.center_m);
  EXPECT_EQ(found->outline->footprint_m, outline->footprint_m);
}

TEST_F(KeptOutlineTest, GoesWithCopiesAndWhereTheObjectIsPutUpright) {
  const auto found = FindLevelOutline(*map_.Find(id_));
  const Transform upright(Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()));
  Thing().mutable_info().T_map_submap = upright;
  EXPECT_EQ(Kept(), found);
  const SubmapId clone = map_.Clone(id_)->id();
  EXPECT_EQ(map_.Find(clone)->kept_outline().Find(upright), found);
  Thing().mutable_info().T_map_submap = Transform(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()));
  EXPECT_EQ(Kept(), nullptr) << "tilted, it is another one";
}

TEST_F(KeptOutlineTest, IsForgottenByWhateverWritesToTheGeometry) {
  const BlockIndex block = map_.Find(id_)->blocks().entries().front().index;
  const auto expect_forgets = [&](const char* what, const auto& write) {
    (void)FindLevelOutline(Thing());
    ASSERT_NE(Kept(), nullptr);
    write(Thing());
    EXPECT_EQ(Kept(), nullptr) << what;
  };
  expect_forgets("TSDF", [&](Submap& s) { s.MutableTsdf(block).weight[0] = 1; });
  expect_forgets("gone", [&](Submap& s) { (void)s.MutableGone(block); });
  expect_forgets("gone, put", [&](Submap& s) { s.PutGone(block, nullptr); });
  expect_forgets("layers", [&](Submap& s) { s.AddLayers(BlockEntry(*s.blocks().Find(block))); });
  expect_forgets("a block", [&](Submap& s) { s.PutBlock(block, std::make_shared<const TsdfBlock>(), nullptr); });
  expect_forgets("an erased block", [&](Submap& s) { s.EraseBlock(block); });
}

TEST_F(KeptOutlineTest, StaysWhereNothingButLabelsAreWritten) {
  const auto found = FindLevelOutline(Thing());
  (void)Thing().MutableLabels(map_.Find(id_)->blocks().entries().front().index);
  Thing().DropLabels();
  EXPECT_EQ(Kept(), found);
}

}  // namespace
}  // namespace dhpmap
