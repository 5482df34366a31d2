// SPDX-License-Identifier: BSD-3-Clause
#include "proto/types/resource_names.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

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

TEST(ResourceNames, AnObjectIsAMapOrASubmap) {
  EXPECT_EQ(ParseObjectName("maps/a", "name")->map, "a");
  EXPECT_FALSE(ParseObjectName("maps/a", "name")->submap.has_value());
  EXPECT_EQ(ParseObjectName("maps/a/submaps/7", "name")->submap, SubmapId(7));
  EXPECT_EQ(ParseObjectName("maps/a/submaps/x", "name").status().reason(), Reason("BAD_NAME"));
}

}  // namespace
}  // namespace dhpmap
