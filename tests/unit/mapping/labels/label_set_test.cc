// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/labels/label_set.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

LabelClass Class(std::uint16_t id, Panoptic panoptic = Panoptic::kThing) {
  return {.id = ClassId(id), .name = "c" + std::to_string(id), .panoptic = panoptic};
}

TEST(LabelSet, SortsAndFindsItsClasses) {
  const auto set = LabelSet::Create({Class(9), Class(0, Panoptic::kStuff), Class(65'534)});
  ASSERT_TRUE(set.ok());
  EXPECT_EQ(set->classes()[0].id, ClassId(0));
  EXPECT_EQ(set->classes()[2].id, ClassId(65'534));
  ASSERT_NE(set->Find(ClassId(9)), nullptr);
  EXPECT_EQ(set->Find(ClassId(9))->name, "c9");
  EXPECT_EQ(set->Find(ClassId(8)), nullptr);
  EXPECT_EQ(set->Find(ClassId(65'535)), nullptr);
}

TEST(LabelSet, MayBeEmpty) {
  const auto set = LabelSet::Create({});
  ASSERT_TRUE(set.ok());
  EXPECT_TRUE(set->empty());
  EXPECT_EQ(set->Find(ClassId(0)), nullptr);
}

TEST(LabelSet, NamesEveryViolationAtOnce) {
  const auto set = LabelSet::Create({Class(5), Class(65'535), Class(5), Class(7, Panoptic::kUnknown)});
  ASSERT_FALSE(set.ok());
  EXPECT_EQ(set.status().code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(set.status().reason(), Reason("BAD_LABEL_SET"));
  std::vector<std::string> fields;
  for (const FieldViolation& violation : set.status().violations()) fields.push_back(violation.field);
  EXPECT_EQ(fields, (std::vector<std::string>{"classes[5]", "classes[7]", "classes[65535]"}));
}

}  // namespace
}  // namespace dhpmap
