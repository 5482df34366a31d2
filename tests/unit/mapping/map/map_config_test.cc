// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/map_config.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <type_traits>

namespace dhpmap {
namespace {

std::vector<std::string> Fields(const Status& status) {
  std::vector<std::string> fields;
  for (const FieldViolation& violation : status.violations()) fields.push_back(violation.field);
  return fields;
}

std::vector<std::string> Keys() {
  std::vector<std::string> keys;
  for (const auto& [key, value] : ConfigToText(MapConfig())) keys.push_back(key);
  return keys;
}

TEST(MapConfig, PresetsAreValidAndApplyByName) {
  EXPECT_TRUE(IndoorConfig().Validate().ok());
  EXPECT_TRUE(OutdoorLidarConfig().Validate().ok()) << OutdoorLidarConfig().Validate().ToString();
  MapConfig config;
  EXPECT_TRUE(ApplyPreset("outdoor_lidar", config).ok());
  EXPECT_EQ(ConfigToText(config), ConfigToText(OutdoorLidarConfig()));
  EXPECT_TRUE(ApplyPreset("indoor", config).ok());
  EXPECT_EQ(ConfigToText(config), ConfigToText(IndoorConfig()));
  EXPECT_EQ(ApplyPreset("moon", config).code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(ConfigToText(config), ConfigToText(IndoorConfig()));
}

TEST(MapConfig, NamesEveryKeyThatIsOutOfRangeAtOnce) {
  MapConfig config;
  std::vector<std::string> spoilt;
  VisitFields(config, [&spoilt](const char* key, auto& value, double, double most, const char*) {
    using Value = std::remove_reference_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, bool>) return;  // cannot be out of range
    if constexpr (std::is_same_v<Value, double>) value = 2 * most + 1;
    if constexpr (std::is_same_v<Value, int>) value = -1;
    if constexpr (std::is_same_v<Value, Weighting>) value = static_cast<Weighting>(7);
    spoilt.emplace_back(key);
  });
  const Status status = config.Validate();
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(status.reason(), Reason("BAD_CONFIG"));
  const std::vector<std::string> named = Fields(status);
  for (const std::string& key : spoilt) {
    EXPECT_NE(std::find(named.begin(), named.end(), key), named.end()) << key << " is not named";
  }
}

TEST(MapConfig, RefusesEachBadNumberUnderItsOwnKeyOnly) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0}) {
    MapConfig config;
    config.integration.max_weight = bad;
    EXPECT_EQ(Fields(config.Validate()), std::vector<std::string>{"integration.max_weight"}) << bad;
    config = {};
    config.voxel_size_m = bad;
    const std::vector<std::string> named = Fields(config.Validate());
    ASSERT_FALSE(named.empty()) << bad;
    EXPECT_EQ(named[0], "voxel_size_m");
  }
}

TEST(MapConfig, TruncationIsOneToEightVoxels) {
  MapConfig config;
  for (const double good : {1.0, 2.0, 8.0}) {
    config.truncation_m = good * config.voxel_size_m;
    EXPECT_TRUE(config.Validate().ok()) << good;
  }
  for (const double bad : {0.9, 8.1}) {
    config.truncation_m = bad * config.voxel_size_m;
    config.tracking.iou_threshold = 2;  // must not hide the other
    EXPECT_EQ(Fields(config.Validate()), (std::vector<std::string>{"tracking.iou_threshold", "truncation_m"})) << bad;
  }
}

TEST(MapConfig, LeastRangeIsBelowTheGreatest) {
  MapConfig config;
  config.integration.min_range_m = config.integration.max_range_m;
  EXPECT_EQ(Fields(config.Validate()), std::vector<std::string>{"integration.min_range_m"});
}

TEST(MapConfig, KeysAreUnique) {
  std::vector<std::string> keys = Keys();
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
  EXPECT_EQ(keys.size(), 33u);
}

TEST(MapConfig, TextRoundTripIsExactForEveryField) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 200; ++round) {
    MapConfig original;
    VisitFields(original, [&random](const char*, auto& value, double least, double most, const char*) {
      using Value = std::remove_reference_t<decltype(value)>;
      if constexpr (std::is_same_v<Value, bool>) value = random() % 2 != 0;
      if constexpr (std::is_same_v<Value, double>) value = std::uniform_real_distribution(least, most)(random);
      if constexpr (std::is_same_v<Value, int>) value = static_cast<int>(random() % 1'000'000);
      if constexpr (std::is_same_v<Value, Weighting>) value = static_cast<Weighting>(random() % 3);
    });
    MapConfig copy;
    for (const auto& [key, text] : ConfigToText(original)) ASSERT_TRUE(SetField(copy, key, text).ok()) << key << text;
    EXPECT_EQ(copy.voxel_size_m, original.voxel_size_m);  // to the last bit
    EXPECT_EQ(copy.integration.max_weight, original.integration.max_weight);
    EXPECT_EQ(copy.integration.weighting, original.integration.weighting);
    EXPECT_EQ(copy.integration.anti_grazing, original.integration.anti_grazing);
    EXPECT_EQ(copy.tracking.min_points_large, original.tracking.min_points_large);
    EXPECT_EQ(ConfigToText(copy), ConfigToText(original));
  }
}

TEST(SetField, RefusesUnknownKeysAndTextThatDoesNotParse) {
  MapConfig config;
  EXPECT_EQ(Fields(SetField(config, "voxel_size", "1")), std::vector<std::string>{"voxel_size"});
  const std::pair<const char*, const char*> bad[] = {{"voxel_size_m", ""},
                                                     {"voxel_size_m", "4cm"},
                                                     {"voxel_size_m", "0.04 "},
                                                     {"tracking.min_points_stuff", "1.5"},
                                                     {"tracking.min_points_stuff", "99999999999"},
                                                     {"integration.anti_grazing", "1"},
                                                     {"integration.anti_grazing", "True"},
                                                     {"integration.weighting", "constant"}};
  for (const auto& [key, text] : bad) {
    const Status status = SetField(config, key, text);
    EXPECT_EQ(status.code(), StatusCode::kInvalidArgument) << key << "=" << text;
    EXPECT_EQ(Fields(status), std::vector<std::string>{key});
  }
  EXPECT_EQ(ConfigToText(config), ConfigToText(MapConfig())) << "a refused value must change nothing";
}

TEST(SetField, IgnoresARetiredKeyAtItsDefaultAndRefusesItOtherwise) {
  MapConfig config;
  ASSERT_FALSE(RetiredFields().empty());
  for (const RetiredField& field : RetiredFields()) {
    const std::string key(field.key);
    EXPECT_NE(FindRetiredField(key), nullptr);
    const std::vector<std::string> keys = Keys();
    EXPECT_EQ(std::count(keys.begin(), keys.end(), key), 0) << key << " is in use";
    EXPECT_TRUE(SetField(config, key, field.default_text).ok()) << key;
    const Status other = SetField(config, key, "7");
    EXPECT_EQ(other.code(), StatusCode::kInvalidArgument) << key;
    EXPECT_EQ(Fields(other), std::vector<std::string>{key});
    EXPECT_NE(other.message().find("retired"), std::string::npos) << other.ToString();
  }
  EXPECT_EQ(FindRetiredField("voxel_size_m"), nullptr);
  EXPECT_EQ(ConfigToText(config), ConfigToText(MapConfig()));
}

}  // namespace
}  // namespace dhpmap
