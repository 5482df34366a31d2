// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <type_traits>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "server/app/status_table.h"
#include "server/grpc/map_conversion.h"
#include "server/grpc/resource_names.h"
#include "server/grpc/status_conversion.h"
#include "server/grpc/submap_conversion.h"

namespace dhpmap {
namespace {

/// Every field off its default, and different from its neighbours.
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

TEST(MapConversion, FieldsThatAreNotSetKeepTheirValue) {
  MapConfig config = StrangeConfig();
  const MapConfig before = config;
  v1::MapConfig proto;
  ASSERT_TRUE(MergeConfig(proto, config).ok());
  EXPECT_EQ(ConfigToText(config), ConfigToText(before));
  proto.mutable_integration()->set_carving(false);
  proto.mutable_integration()->set_weighting(v1::WEIGHTING_UNSPECIFIED);
  ASSERT_TRUE(MergeConfig(proto, config).ok());
  EXPECT_FALSE(config.integration.carving);
  EXPECT_EQ(config.integration.weighting, before.integration.weighting);
  proto.mutable_integration()->set_weighting(static_cast<v1::Weighting>(42));
  EXPECT_EQ(MergeConfig(proto, config).code(), StatusCode::kInvalidArgument);
}

TEST(MapConversion, BadClassesAreNamedAtOnce) {
  google::protobuf::RepeatedPtrField<v1::LabelClass> classes;
  v1::LabelClass* a = classes.Add();
  a->set_id(65535);
  a->set_kind(v1::THING);
  v1::LabelClass* b = classes.Add();
  b->mutable_color()->set_g(256);
  EXPECT_EQ(LabelSetFromProto(classes).status().violations().size(), 3u);  // id; kind and colour
  classes.Clear();
  EXPECT_TRUE(LabelSetFromProto(classes).ok());
  for (int i = 0; i < 2; ++i) {
    v1::LabelClass* twice = classes.Add();
    twice->set_id(4);
    twice->set_kind(v1::STUFF);
  }
  EXPECT_EQ(LabelSetFromProto(classes).status().code(), StatusCode::kInvalidArgument);
}

TEST(ResourceNames, RoundTrip) {
  EXPECT_EQ(*ParseMapName("maps/a.b-c_1", "name"), "a.b-c_1");
  const auto submap = ParseSubmapName("maps/a/submaps/4294967295", "name");
  ASSERT_TRUE(submap.ok());
  EXPECT_EQ(submap->map, "a");
  EXPECT_EQ(submap->submap.value, 4294967295u);
  EXPECT_EQ(SubmapResourceName("a", SubmapId(7)), "maps/a/submaps/7");
  EXPECT_EQ(ParseSubmapName("maps/a/submaps/0", "name")->submap, kUnknownSubmap);
}

TEST(ResourceNames, MalformedOnesAreInvalidAndNameTheirField) {
  for (const char* name : {"", "maps", "maps/", "a", "maps/A", "maps/a/b", "Maps/a", "maps/../x", " maps/a"}) {
    const auto result = ParseMapName(name, "parent");
    ASSERT_FALSE(result.ok()) << name;
    EXPECT_EQ(result.status().code(), StatusCode::kInvalidArgument);
    EXPECT_EQ(result.status().violations().at(0).field, "parent");
  }
  for (const char* name : {"maps/a", "maps/a/submaps/", "maps/a/submaps/x", "maps/a/submaps/-1", "maps/a/submaps/07",
                           "maps/a/submaps/1/", "maps/a/submaps/4294967296", "maps/A/submaps/1", "submaps/1"}) {
    EXPECT_EQ(ParseSubmapName(name, "name").status().code(), StatusCode::kInvalidArgument) << name;
  }
}

TEST(StatusConversion, EveryCodeKeepsItsNumberMessageAndReason) {
  for (const StatusRow& row : StatusTable()) {
    if (row.code == StatusCode::kOk) continue;
    const grpc::Status status = ToGrpc(Status(row.code, "what happened").WithReason("WHY"));
    EXPECT_EQ(static_cast<int>(status.error_code()), row.grpc_code);
    EXPECT_EQ(status.error_message(), "what happened");
    google::rpc::Status details;
    ASSERT_TRUE(details.ParseFromString(status.error_details()));
    EXPECT_EQ(details.code(), row.grpc_code);
    google::rpc::ErrorInfo info;
    ASSERT_TRUE(details.details(0).UnpackTo(&info));
    EXPECT_EQ(info.reason(), "WHY");
  }
  EXPECT_TRUE(ToGrpc(Status::Ok()).ok());
}

TEST(SubmapConversion, AnUpdateMaskMayOnlyNameWhatCanBeChanged) {
  v1::UpdateSubmapRequest request;
  for (const char* path : {"display_name", "class_id", "map_from_submap.rotation.w", "etag", "name"}) {
    request.mutable_update_mask()->add_paths(path);
  }
  EXPECT_TRUE(CheckUpdateMask(request).ok());
  for (const char* path : {"voxel_size_m", "nope", "map_from_submap.nope"})
    request.mutable_update_mask()->add_paths(path);
  EXPECT_EQ(CheckUpdateMask(request).violations().size(), 3u);
}

}  // namespace
}  // namespace dhpmap
