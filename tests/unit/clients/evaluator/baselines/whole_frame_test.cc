// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/whole_frame.h"

#include <gtest/gtest.h>

#include "clients/evaluator/baselines/baselines.h"
#include "mapping/fusion/band_size.h"
#include "tests/support/scenes.h"

namespace dhpmap::evaluator {
namespace {

/// Every point in a block of its own.
PanopticFrame ScanOfBlocks(std::size_t num_points, double voxel_size_m) {
  const double block_m = kBlockSide * voxel_size_m;
  PanopticFrame frame;
  frame.segments = {{.id = SegmentId(1), .class_id = ClassId(1)}};
  LidarData& data = frame.lidar.emplace();
  data.segments.assign(num_points, 1);
  data.points_m.reserve(num_points);
  for (std::size_t i = 0; i < num_points; ++i) {
    const Eigen::Vector3d block(static_cast<double>(i % 64), static_cast<double>(i / 64 % 64),
                                static_cast<double>(i / 4096));
    data.points_m.push_back(((block + Eigen::Vector3d::Constant(0.5)) * block_m).cast<float>());
  }
  return frame;
}

TEST(Baselines, RefuseAFrameThatTouchesTooManyBlocksAndGoOn) {
  SystemSetup setup{IndoorConfig(), testing::MakeLabelSet(1, 1), 1};
  setup.config.integration.max_range_m = 100;
  const PanopticFrame too_large = ScanOfBlocks(kMaxBlocksAFrame + 1, setup.config.voxel_size_m);
  const PanopticFrame small = ScanOfBlocks(8, setup.config.voxel_size_m);
  for (const auto make : {&MakePanmap, &MakeKimera, &MakeVotes}) {
    const auto system = make(setup);
    const Status status = system->Integrate(too_large);
    EXPECT_EQ(status.code(), StatusCode::kResourceExhausted) << system->name();
    EXPECT_TRUE(status.reason() == Reason("FRAME_TOO_LARGE")) << system->name();
    EXPECT_EQ(system->times().num_frames, 0);
    EXPECT_TRUE(system->Surface().mesh.vertices_m.empty());
    EXPECT_TRUE(system->Integrate(small).ok()) << system->name();
  }
}

}  // namespace
}  // namespace dhpmap::evaluator
