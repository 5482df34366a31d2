// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/labels/class_names.h"

#include <gtest/gtest.h>

#include <string>

namespace dhpmap {
namespace {

LabelClass Class(std::uint16_t id, std::string name) { return {.id = ClassId(id), .name = std::move(name)}; }

TEST(ClassNames, AreEachOfOneClass) {
  EXPECT_TRUE(ValidateClassNames({Class(1, "chair"), Class(2, "sofa"), Class(3, "Chair")}).ok());
  const Status status = ValidateClassNames({Class(1, "chair"), Class(2, "sofa"), Class(7, "chair")});
  ASSERT_EQ(status.code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(status.reason(), Reason("BAD_LABEL_SET"));
  ASSERT_EQ(status.violations().size(), 1u);
  EXPECT_EQ(status.violations()[0].field, "classes[7].name");
}

TEST(ClassNames, MayBeMissing) { EXPECT_TRUE(ValidateClassNames({Class(1, ""), Class(2, "")}).ok()); }

TEST(ClassNames, AreBoundedOneByOneAndTogether) {
  EXPECT_TRUE(ValidateClassNames({Class(1, std::string(kMaxClassNameBytes, 'x'))}).ok());
  EXPECT_FALSE(ValidateClassNames({Class(1, std::string(kMaxClassNameBytes + 1, 'x'))}).ok());
  std::vector<LabelClass> many;
  for (std::uint16_t id = 0; id < 10'000; ++id) many.push_back(Class(id, std::to_string(id) + std::string(110, 'x')));
  const Status status = ValidateClassNames(many);
  ASSERT_EQ(status.violations().size(), 1u);
  EXPECT_EQ(status.violations()[0].field, "classes");
}

}  // namespace
}  // namespace dhpmap
