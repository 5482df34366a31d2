// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/map_settings.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

TEST(ApplySetting, SetsFieldsOfEveryTypeAtAnyDepth) {
  v1::MapConfig config;
  for (const char* setting : {"voxel_size_m=0.05", "integration.anti_grazing=true", "integration.weighting=constant",
                              "tracking.min_points_small=7"}) {
    const Status status = ApplySetting(setting, config);
    EXPECT_TRUE(status.ok()) << status.ToString();
  }
  EXPECT_DOUBLE_EQ(config.voxel_size_m(), 0.05);
  EXPECT_TRUE(config.integration().anti_grazing());
  EXPECT_EQ(config.integration().weighting(), v1::IntegrationConfig::CONSTANT);
  EXPECT_EQ(config.tracking().min_points_small(), 7);
  EXPECT_FALSE(config.has_truncation_m()) << "what is not said takes the preset's value";
}

TEST(ApplySetting, NamesTheKeysThereAreForOneThatIsNot) {
  v1::MapConfig config;
  for (const char* setting : {"voxel=1", "integration=1", "integration.anti_grazing.x=1", "voxel_size_m.x=1", "=1"}) {
    const Status status = ApplySetting(setting, config);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument) << setting;
    EXPECT_NE(status.message().find("tracking.iou_threshold"), std::string::npos) << status.message();
  }
}

TEST(ApplySetting, RefusesValuesOfAnotherType) {
  v1::MapConfig config;
  for (const char* setting : {"voxel_size_m=big", "voxel_size_m=nan", "voxel_size_m=", "integration.anti_grazing=1",
                              "tracking.min_points_small=1.5", "integration.weighting=heavy", "voxel_size_m"}) {
    EXPECT_EQ(ApplySetting(setting, config).code(), StatusCode::kInvalidArgument) << setting;
  }
}

}  // namespace
}  // namespace dhpmap
