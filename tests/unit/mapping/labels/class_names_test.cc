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

TEST(FindClassByName, TakesAnyCaseAndBlanksAround) {
  const LabelSet set = *LabelSet::Create({Class(1, "coffee table"), Class(2, "Sofa "), Class(3, "")});
  for (const char* name : {"coffee table", "Coffee Table", " coffee table\t"}) {
    const LabelClass* found = FindClassByName(set, name);
    ASSERT_NE(found, nullptr) << name;
    EXPECT_EQ(found->id, ClassId(1)) << name;
  }
  EXPECT_EQ(FindClassByName(set, "sofa")->id, ClassId(2));
  for (const char* name : {"coffeetable", "table", "", " "}) EXPECT_EQ(FindClassByName(set, name), nullptr) << name;
}

TEST(FindClassByName, PrefersTheExactName) {
  const LabelSet set = *LabelSet::Create({Class(1, "chair"), Class(2, "Chair"), Class(3, "CHAIR")});
  EXPECT_EQ(FindClassByName(set, "Chair")->id, ClassId(2));
  EXPECT_EQ(FindClassByName(set, "CHAIR")->id, ClassId(3));
  EXPECT_EQ(FindClassByName(set, "chAIR")->id, ClassId(1)) << "of equals the first by id";
}

TEST(NoSuchClassText, SaysWhatWasNear) {
  const LabelSet set = *LabelSet::Create({Class(1, "coffee table"), Class(2, "sofa")});
  EXPECT_EQ(NoSuchClassText(set, "sofaa"), "there is no class 'sofaa'; did you mean 'sofa'?");
  EXPECT_EQ(NoSuchClassText(set, "spoon"), "there is no class 'spoon'");
  Status told = InvalidArgument("no classes");
  for (int i = 0; i < 10; ++i) told.AddViolation("class_names", NoSuchClassText(set, "sofaa", told));
  EXPECT_EQ(told.violations()[0].description, "there is no class 'sofaa'; did you mean 'sofa'?");
  EXPECT_EQ(told.violations()[9].description, "there is no class 'sofaa'") << "a request may name a million";
}

}  // namespace
}  // namespace dhpmap
