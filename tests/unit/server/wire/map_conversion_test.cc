// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/map_conversion.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <string>
#include <type_traits>

namespace dhpmap {
namespace {

/// Every field differs from its default and from its neighbours.
MapConfig StrangeConfig() {
  MapConfig config;
  int i = 0;
  VisitFields(config, [&i](const char*, auto& value, double, double, const char*) {
    using Value = std::remove_reference_t<decltype(value)>;
    ++i;
    if constexpr (std::is_same_v<Value, bool>) value = !value;
    else if constexpr (std::is_same_v<Value, Weighting>) value = Weighting::kInverseRangeSquared;
    else value = static_cast<Value>(value + i);
  });
  return config;
}

TEST(MapConversion, EveryConfigKeyMapsBothWays) {
  const MapConfig config = StrangeConfig();
  MapConfig back;
  ASSERT_TRUE(MergeConfig(ToProto(config), back).ok());
  EXPECT_EQ(ConfigToText(back), ConfigToText(config));
  EXPECT_NE(ConfigToText(back), ConfigToText(MapConfig{}));
}

int NumLeaves(const google::protobuf::Descriptor& message) {
  int num_leaves = 0;
  for (int i = 0; i < message.field_count(); ++i) {
    if (message.field(i)->options().deprecated()) continue;
    const auto* section = message.field(i)->message_type();
    num_leaves += section == nullptr ? 1 : NumLeaves(*section);
  }
  return num_leaves;
}

TEST(MapConversion, TheProtoHasNoFieldThatTheConfigLacks) {
  int num_keys = 0;
  MapConfig config;
  VisitFields(config, [&num_keys](const char*, auto&, double, double, const char*) { ++num_keys; });
  EXPECT_EQ(NumLeaves(*v1::MapConfig::descriptor()), num_keys);
}

TEST(MapConversion, ARetiredFieldMayOnlyBeAtItsDefault) {
  using google::protobuf::TextFormat;
  MapConfig config;
  v1::MapConfig proto;
  ASSERT_TRUE(TextFormat::ParseFromString("integration { carving: false }", &proto));
  EXPECT_TRUE(MergeConfig(proto, config).ok());
  ASSERT_TRUE(TextFormat::ParseFromString("integration { carving: true }", &proto));
  const Status refused = MergeConfig(proto, config);
  EXPECT_EQ(refused.reason(), Reason("BAD_CONFIG"));
  ASSERT_EQ(refused.violations().size(), 1u);
  EXPECT_EQ(refused.violations()[0].field, "config.integration.carving");
}

TEST(MapConversion, UnsetFieldsKeepTheirValue) {
  MapConfig config = StrangeConfig();
  const MapConfig before = config;
  v1::MapConfig proto;
  ASSERT_TRUE(MergeConfig(proto, config).ok());
  EXPECT_EQ(ConfigToText(config), ConfigToText(before));
  proto.mutable_integration()->set_anti_grazing(false);
  proto.mutable_integration()->set_weighting(v1::IntegrationConfig::WEIGHTING_UNSPECIFIED);
  ASSERT_TRUE(MergeConfig(proto, config).ok());
  EXPECT_FALSE(config.integration.anti_grazing);
  EXPECT_EQ(config.integration.weighting, before.integration.weighting);
  proto.mutable_integration()->set_weighting(static_cast<v1::IntegrationConfig::Weighting>(42));
  EXPECT_EQ(MergeConfig(proto, config).code(), StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace dhpmap
