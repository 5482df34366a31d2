// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/map_edits.h"

#include <gtest/gtest.h>

#include "server/app/etag.h"

namespace dhpmap {
namespace {

TEST(PatchMap, RenamesAndIsARevision) {
  Map map{MapInfo{}};
  const auto before = map.Publish(0);
  ASSERT_TRUE(PatchMap(map, EtagOf(map.info()), {.display_name = "home"}).ok());
  const auto after = map.Publish(0);
  EXPECT_EQ(after->info().display_name, "home");
  EXPECT_EQ(after->revision(), before->revision() + 1);
}

TEST(PatchMap, ThatChangesNothingIsNoRevision) {
  Map map{MapInfo{}};
  const auto before = map.Publish(0);
  EXPECT_TRUE(PatchMap(map, "", {}).ok());
  EXPECT_TRUE(PatchMap(map, "", {.display_name = ""}).ok());
  EXPECT_EQ(map.Publish(0), before);
}

TEST(PatchMap, RefusesAnEtagThatIsNotThePresentOneAndATitleTooLong) {
  Map map{MapInfo{}};
  const auto before = map.Publish(0);
  EXPECT_EQ(PatchMap(map, "x", {.display_name = "home"}).code(), StatusCode::kAborted);
  const Status status = PatchMap(map, "", {.display_name = std::string(kMaxDisplayNameBytes + 1, 'x')});
  ASSERT_EQ(status.violations().size(), 1u);
  EXPECT_EQ(status.violations()[0].field, "display_name");
  EXPECT_EQ(map.Publish(0), before);
}

}  // namespace
}  // namespace dhpmap
