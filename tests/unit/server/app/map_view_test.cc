// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/states/map_view.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <new>
#include <thread>
#include <utility>
#include <vector>

#include "server/app/states/visible_snapshot.h"

namespace dhpmap {
namespace {

MapInfo ViewedInfo() {
  MapInfo info;
  info.name = "room";
  return info;
}

/// Some submaps of a few voxels each, one of them empty.
std::shared_ptr<const MapSnapshot> Made() {
  Map map(ViewedInfo());
  for (int i = 0; i < 5; ++i) {
    SubmapInfo info;
    info.voxel_size_m = 0.1;
    info.T_map_submap.translation() = Eigen::Vector3d(i, 0, 0);
    Submap& submap = map.Create(info);
    for (int voxel = 0; voxel < 3 * i; ++voxel)
      submap.MutableTsdf({voxel, i, 0}).weight[static_cast<std::size_t>(7 * voxel)] = 1;
  }
  return map.Publish(0);
}

TEST(MapView, CachesRequestedSpheresForAllReaders) {
  const MapView view(Made());
  const auto expect_all = [&view] {
    for (int round = 0; round < 3; ++round) {
      for (const auto& submap : view.snapshot().submaps()) {
        const BoundingSphere seen = view.ObservedSphereInMap(*submap), expected = SphereOfObservedInMap(*submap);
        EXPECT_EQ(seen.IsEmpty(), expected.IsEmpty());
        EXPECT_EQ(seen.center_m, expected.center_m);
        EXPECT_EQ(seen.radius_m, expected.radius_m);
      }
    }
  };
  std::vector<std::thread> threads;
  threads.reserve(4);
  for (int i = 0; i < 4; ++i) threads.emplace_back(expect_all);
  for (std::thread& thread : threads) thread.join();
}

TEST(MapView, ReusesTheIndexOfThePreviousView) {
  Map map(ViewedInfo());
  for (int i = 0; i < 12; ++i) {
    SubmapInfo info;
    info.voxel_size_m = 0.1;
    info.T_map_submap.translation() = Eigen::Vector3d(i, 0, 0);
    map.Create(info).MutableTsdf({0, 0, 0}).weight[0] = 1;
    map.FindMutable(map.submaps().back()->id())->UpdateBoundingSphere();
  }
  auto before = std::make_unique<const MapView>(map.Publish(0));
  const SubmapId moved = map.submaps().back()->id();
  EXPECT_EQ(before->lookup().At({11.05, 0.05, 0.05}).submap, moved);
  map.FindMutable(moved)->mutable_info().T_map_submap.translation().y() = 2;
  const MapView not_asked(map.Publish(1), before.get());
  before.reset();
  map.FindMutable(moved)->mutable_info().T_map_submap.translation().y() = 3;
  const MapView after(map.Publish(2), &not_asked), fresh(after.shared_snapshot());
  EXPECT_EQ(after.lookup().index().num_replaced(), 1u) << "though nobody asked the view between";
  EXPECT_EQ(fresh.lookup().index().num_replaced(), 0u);
  for (const MapView* view : {&after, &fresh}) {
    EXPECT_EQ(view->lookup().At({11.05, 3.05, 0.05}).submap, moved);
    EXPECT_FALSE(view->lookup().At({11.05, 0.05, 0.05}).is_observed);
    EXPECT_TRUE(view->lookup().At({5.05, 0.05, 0.05}).is_observed);
  }
}

/// States of a map, and requests to prepare them.
class VisibleSnapshotTest : public ::testing::Test {
 protected:
  std::shared_ptr<const MapView> Next() {
    map_.Create({});
    return std::make_shared<const MapView>(map_.Publish(0));
  }

  Map map_{ViewedInfo()};
  const std::shared_ptr<const MapView> first_ = Next();
  std::vector<std::function<void()>> ready_;  // of each that was handed in
  std::shared_ptr<VisibleSnapshot> shown_ =
      std::make_shared<VisibleSnapshot>(first_, [this](const VisibleSnapshot::State&, std::function<void()> ready) {
        ready_.push_back(std::move(ready));
        return true;
      });
};

TEST_F(VisibleSnapshotTest, AStateIsVisibleOnceItIsPrepared) {
  const auto second = Next();
  shown_->ShowPrepared(second);
  EXPECT_EQ(shown_->Get(), first_);
  EXPECT_EQ(shown_->Newest(), second);
  EXPECT_TRUE(shown_->IsWaiting());
  ready_[0]();
  EXPECT_EQ(shown_->Get(), second);
  EXPECT_FALSE(shown_->IsWaiting());
}

TEST_F(VisibleSnapshotTest, AWaitingStateIsShownWhenTheNextArrivesAndNoneReturns) {
  const auto second = Next(), third = Next(), fourth = Next();
  shown_->ShowPrepared(second);
  shown_->ShowPrepared(third);
  EXPECT_EQ(shown_->Get(), second);
  ready_[0]();
  EXPECT_EQ(shown_->Get(), second) << "the third is not prepared yet";
  shown_->Show(fourth);
  EXPECT_EQ(shown_->Get(), fourth);
  EXPECT_FALSE(ready_[2]) << "nobody waits for it";
  ready_[1]();
  EXPECT_EQ(shown_->Get(), fourth);
  EXPECT_FALSE(shown_->IsWaiting());
}

TEST_F(VisibleSnapshotTest, AStateWithoutPreparationIsVisibleAtOnce) {
  const auto second = Next(), third = Next();
  VisibleSnapshot::Prepare refuse = [](const VisibleSnapshot::State&, const std::function<void()>&) { return false; };
  VisibleSnapshot::Prepare fail = [](const VisibleSnapshot::State&, const std::function<void()>&) -> bool {
    throw std::bad_alloc();
  };
  for (const VisibleSnapshot::Prepare& prepare : {VisibleSnapshot::Prepare(), std::move(refuse), std::move(fail)}) {
    const auto shown = std::make_shared<VisibleSnapshot>(first_, prepare);
    shown->ShowPrepared(second);
    EXPECT_EQ(shown->Get(), second);
    shown->Show(third);
    EXPECT_EQ(shown->Get(), third);
  }
}

TEST_F(VisibleSnapshotTest, APreparationThatEndsAfterTheMapIsHarmless) {
  shown_->ShowPrepared(Next());
  shown_.reset();
  ready_[0]();
}

}  // namespace
}  // namespace dhpmap
