// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/plausibility/frame_judge.h"

#include <gtest/gtest.h>

#include "tests/unit/mapping/plausibility/mistakes.h"
#include "tests/unit/mapping/plausibility/walked_room.h"

namespace dhpmap {
namespace {

using testing::EmptyMap;
using testing::FuseAndCheck;
using testing::Mistake;
using testing::MistakesOfDepthCameras;
using testing::Tells;
using testing::Told;
using testing::WalkFrame;

constexpr int kFewFrames = 10;

TEST(FrameJudge, FramesThatAreRightFitAndAreNotDoubted) {
  MapBuilder builder(EmptyMap(), 1);
  for (int i = 0; i < 2 * kFewFrames; ++i) {
    const FrameCheck check = FuseAndCheck(builder, WalkFrame(i));
    EXPECT_TRUE(check.IsPlausible()) << i << ": " << Told(check);
    ASSERT_TRUE(check.fit);
    ASSERT_TRUE(check.fit->valid_depth_fraction);
    EXPECT_EQ(check.fit->agreeing_fraction.has_value(), i > 0) << "the first one meets nothing";
    if (i == 0) continue;
    EXPECT_GT(check.fit->agreeing_fraction, 0.97) << i;
    ASSERT_TRUE(check.fit->median_residual_m);
    EXPECT_LT(check.fit->median_residual_m, 0.005) << i << ": exact depth, voxels of 4 cm";
  }
}

TEST(FrameJudge, FindsAMistakeThatAllFramesOfAClientShare) {
  for (const Mistake& mistake : MistakesOfDepthCameras()) {
    MapBuilder builder(EmptyMap(), 1);
    int found_at = -1;
    for (int i = 0; i < kFewFrames; ++i) {
      PanopticFrame frame = WalkFrame(i);
      mistake.make(frame);
      const FrameCheck check = FuseAndCheck(builder, frame);
      if (found_at < 0 && Tells(check, mistake.fault)) found_at = i;
      EXPECT_TRUE(check.IsPlausible() || Tells(check, mistake.fault))
          << FaultName(mistake.fault) << ": " << Told(check);
    }
    EXPECT_GE(found_at, 0) << FaultName(mistake.fault);
    EXPECT_LE(found_at, 3) << FaultName(mistake.fault);
  }
}

TEST(FrameJudge, FindsAMistakeThatAClientBeginsToMakeOnAGoodMap) {
  for (const Mistake& mistake : MistakesOfDepthCameras()) {
    MapBuilder builder(EmptyMap(), 1);
    for (int i = 0; i < kFewFrames; ++i) (void)FuseAndCheck(builder, WalkFrame(i));
    bool is_found = false;
    for (int i = kFewFrames; i < 2 * kFewFrames; ++i) {
      PanopticFrame frame = WalkFrame(i);
      frame.session = "another";
      mistake.make(frame);
      is_found = is_found || Tells(FuseAndCheck(builder, frame), mistake.fault);
    }
    EXPECT_TRUE(is_found) << FaultName(mistake.fault);
  }
}

TEST(FrameJudge, AFrameThatMeetsNothingKnownIsNotDoubted) {
  MapBuilder builder(EmptyMap(), 1);
  for (int i = 0; i < kFewFrames; ++i) (void)FuseAndCheck(builder, WalkFrame(i));
  PanopticFrame frame = WalkFrame(0);
  frame.T_map_sensor.translation() += Eigen::Vector3d(0, 0, 15);  // on another floor
  frame.stamp_ns = kFewFrames * 2 * testing::kWalkPeriod_ns;
  const FrameCheck check = FuseAndCheck(builder, frame);
  EXPECT_TRUE(check.IsPlausible()) << Told(check);
  EXPECT_FALSE(check.fit->agreeing_fraction) << "nobody can tell";
  EXPECT_FALSE(check.fit->median_residual_m);
  EXPECT_TRUE(check.fit->valid_depth_fraction);
}

TEST(FrameJudge, SomethingThatComesBeforeTheCameraIsNoMistakeOfTheFrame) {
  MapBuilder builder(EmptyMap(), 1);
  for (int i = 0; i < kFewFrames; ++i) (void)FuseAndCheck(builder, WalkFrame(i));
  for (const double radius_m : {0.1, 0.2, 0.4}) {
    PanopticFrame frame = WalkFrame(kFewFrames);
    testing::Scene room = testing::FurnishedRoom();
    room.solids.push_back({.shape = testing::Solid::Shape::kSphere,
                           .center_m = frame.T_map_sensor * Eigen::Vector3d(0, 0, 0.6),
                           .size_m = {radius_m, 0, 0}});
    const std::int64_t stamp_ns = frame.stamp_ns;
    frame = Render(room, testing::SmallCamera(), frame.T_map_sensor);
    frame.camera->segments.clear();
    frame.stamp_ns = stamp_ns;
    MapBuilder seen(builder.map().Publish(0), 1);
    const FrameCheck check = FuseAndCheck(seen, frame);
    EXPECT_TRUE(check.IsPlausible()) << radius_m << ": " << Told(check);
    EXPECT_LT(check.fit->agreeing_fraction, 1) << radius_m;
  }
}

TEST(FrameJudge, WhatWasTakenAwayIsNoMistakeOfTheFrame) {
  testing::Scene screened = testing::FurnishedRoom();
  screened.solids.push_back({.shape = testing::Solid::Shape::kBox,
                             .center_m = testing::WalkPose(kFewFrames) * Eigen::Vector3d(0, 0, 1.2),
                             .size_m = {0.7, 0.7, 0.7}});
  MapBuilder builder(EmptyMap(), 1);
  for (int i = 0; i < kFewFrames; ++i) {
    PanopticFrame frame = Render(screened, testing::SmallCamera(), testing::WalkPose(i));
    frame.camera->segments.clear();
    frame.stamp_ns = WalkFrame(i).stamp_ns;
    (void)FuseAndCheck(builder, frame);
  }
  for (int i = kFewFrames; i < 2 * kFewFrames; ++i) {
    const FrameCheck check = FuseAndCheck(builder, WalkFrame(i));
    EXPECT_TRUE(check.IsPlausible()) << i << ": " << Told(check);
  }
}

TEST(FrameJudge, APoseThatIsOffIsToldThoughNobodyKnowsWhy) {
  MapBuilder mapped(EmptyMap(), 1);
  for (int i = 0; i < 2 * kFewFrames; ++i) (void)FuseAndCheck(mapped, WalkFrame(i));
  const auto map = mapped.map().Publish(0);
  const auto check_of = [&map](double aside_m, double turn_rad) {
    MapBuilder builder(map, 1);
    PanopticFrame frame = WalkFrame(kFewFrames);
    frame.T_map_sensor = Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()) * frame.T_map_sensor;
    frame.T_map_sensor.translation() += Eigen::Vector3d(0, aside_m, 0);
    return FuseAndCheck(builder, frame);
  };
  for (const auto& [aside_m, turn_rad] : {std::pair{0.5, 0.4}, {0.3, 0.2}, {-0.6, -0.4}}) {
    const FrameCheck check = check_of(aside_m, turn_rad);
    EXPECT_TRUE(Tells(check, FrameFault::kDisagrees))
        << aside_m << " " << turn_rad << ": " << *check.fit->agreeing_fraction;
    EXPECT_LT(check.fit->agreeing_fraction, 0.7) << "floor and ceiling are the same everywhere";
  }
  EXPECT_TRUE(check_of(-0.6, 0.2).IsPlausible()) << "all is nearer: it may be that something new stands there";
  EXPECT_LT(check_of(-0.6, 0.2).fit->agreeing_fraction, 0.5);
  EXPECT_TRUE(check_of(0.02, 0.005).IsPlausible()) << "poses are never exact";
  EXPECT_GT(check_of(0.02, 0.005).fit->median_residual_m, 0.004) << "but it is told how far off they are";
}

TEST(FrameJudge, StampsMustGoForwardWithinASession) {
  MapBuilder builder(EmptyMap(), 1);
  const auto check_of = [&builder](std::int64_t stamp_ns, const char* session) {
    PanopticFrame frame = WalkFrame(0);
    frame.stamp_ns = stamp_ns;
    frame.session = session;
    return FuseAndCheck(builder, frame);
  };
  EXPECT_TRUE(check_of(-5, "a").IsPlausible()) << "the first may have any";
  EXPECT_TRUE(Tells(check_of(-5, "a"), FrameFault::kStampRepeated));
  EXPECT_TRUE(Tells(check_of(-6, "a"), FrameFault::kStampWentBack));
  EXPECT_TRUE(check_of(-5, "a").IsPlausible()) << "after the one before it";
  EXPECT_TRUE(check_of(-9, "b").IsPlausible()) << "another clock";
  EXPECT_TRUE(Tells(check_of(-5, "a"), FrameFault::kStampRepeated));
  builder.ForgetStamp("a");
  EXPECT_TRUE(check_of(-7, "a").IsPlausible());
  EXPECT_TRUE(Tells(check_of(-9, "b"), FrameFault::kStampRepeated)) << "that one was not forgotten";
}

TEST(FrameJudge, WhatIsToBeRefusedChangesNothing) {
  for (const Mistake& mistake : MistakesOfDepthCameras()) {
    MapBuilder builder(EmptyMap(), 1);
    int num_refused = 0;
    for (int i = 0; i < kFewFrames; ++i) {
      PanopticFrame frame = WalkFrame(i);
      mistake.make(frame);
      const auto before = builder.map().Publish(0);
      const auto report = builder.Integrate(frame, {}, ImplausibleFrames::kRefuse);
      if (report.ok()) continue;
      ++num_refused;
      EXPECT_EQ(report.status().code(), StatusCode::kInvalidArgument);
      EXPECT_EQ(report.status().reason().name(), "IMPLAUSIBLE_FRAME");
      EXPECT_TRUE(Tells(builder.TakeCheck(), mistake.fault)) << "and it is told";
      EXPECT_EQ(builder.map().Publish(0), before);
    }
    EXPECT_GE(num_refused, kFewFrames - 4) << FaultName(mistake.fault);
  }
}

TEST(FrameJudge, ARefusedStampIsNoStampToGoOnFrom) {
  MapBuilder builder(EmptyMap(), 1);
  const auto is_taken = [&builder](std::int64_t stamp_ns) {
    PanopticFrame frame = WalkFrame(0);
    frame.stamp_ns = stamp_ns;
    return builder.Integrate(frame, {}, ImplausibleFrames::kRefuse).ok();
  };
  EXPECT_TRUE(is_taken(10));
  EXPECT_FALSE(is_taken(3));
  EXPECT_FALSE(is_taken(4));
  EXPECT_FALSE(is_taken(10));
  EXPECT_TRUE(is_taken(11));
}

TEST(FrameJudge, KnowsTheSessionsThatWereHeardOfLast) {
  MapBuilder builder(EmptyMap(), 1);
  const auto check_of = [&builder](const std::string& session) {
    PanopticFrame frame = WalkFrame(0);
    frame.session = session;
    return FuseAndCheck(builder, frame);
  };
  for (int i = 0; i < 16; ++i) EXPECT_TRUE(check_of(std::to_string(i)).IsPlausible());
  EXPECT_TRUE(Tells(check_of("0"), FrameFault::kStampRepeated));
  EXPECT_TRUE(check_of("another").IsPlausible());
  EXPECT_TRUE(Tells(check_of("0"), FrameFault::kStampRepeated));
  EXPECT_TRUE(check_of("1").IsPlausible()) << "forgotten for the other one: memory is bounded";
}

}  // namespace
}  // namespace dhpmap
