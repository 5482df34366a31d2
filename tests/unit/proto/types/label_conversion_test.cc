// SPDX-License-Identifier: BSD-3-Clause
#include "proto/types/label_conversion.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

TEST(LabelConversion, BadClassesAreNamedAtOnce) {
  google::protobuf::RepeatedPtrField<v1::LabelClass> classes;
  v1::LabelClass* a = classes.Add();
  a->set_id(65535);
  a->set_kind(v1::LabelClass::THING);
  v1::LabelClass* b = classes.Add();
  b->mutable_color()->set_g(256);
  EXPECT_EQ(LabelSetFromProto(classes).status().violations().size(), 3u);  // id; kind and colour
  classes.Clear();
  EXPECT_TRUE(LabelSetFromProto(classes).ok());
  for (int i = 0; i < 2; ++i) {
    v1::LabelClass* same = classes.Add();
    same->set_id(4);
    same->set_kind(v1::LabelClass::STUFF);
  }
  const Status twice = LabelSetFromProto(classes).status();
  EXPECT_EQ(twice.code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(twice.reason(), Reason("BAD_LABEL_SET"));
  ASSERT_EQ(twice.violations().size(), 1u);
  EXPECT_EQ(twice.violations()[0].field, "label_classes[4]") << "as the request calls it";
}

TEST(LabelConversion, AClassKeepsAllItSaysBothWays) {
  int id = 0;
  for (const Panoptic panoptic : {Panoptic::kThing, Panoptic::kStuff}) {
    for (const SizeClass size : {SizeClass::kSmall, SizeClass::kMedium, SizeClass::kLarge}) {
      const LabelClass before{.id = ClassId(static_cast<std::uint16_t>(id++)),
                              .name = "class " + std::to_string(id),
                              .panoptic = panoptic,
                              .size = size,
                              .color = {1, 2, 255}};
      google::protobuf::RepeatedPtrField<v1::LabelClass> classes;
      *classes.Add() = ToProto(before);
      const auto after = LabelSetFromProto(classes);
      ASSERT_TRUE(after.ok()) << after.status().ToString();
      EXPECT_EQ(after->classes()[0], before);
    }
  }
  EXPECT_EQ(ToProto(Panoptic::kUnknown), v1::LabelClass::PANOPTIC_KIND_UNSPECIFIED);
}

}  // namespace
}  // namespace dhpmap
