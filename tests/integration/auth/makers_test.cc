// SPDX-License-Identifier: BSD-3-Clause
// Who may create maps, and which: quotas, and keys for some maps only.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/integration/auth/locked_server.h"

namespace dhpmap::testing {
namespace {

TEST(AttacksOfMakers, APrincipalCannotExceedItsNumberOfMaps) {
  LockedServer locked({.maps = 2});
  const std::string spot = locked.MakeKey({.name = "spot", .role = auth::Role::kRobot});
  const auto create = [&](const std::string& key, const char* id) {
    return locked.Call(key, &MapStub::CreateMap, CreateRequest(id));
  };
  ASSERT_OK(create(spot, "a"));
  EXPECT_EQ(create(spot, "a").reason(), "MAP_EXISTS") << "which is none more";
  ASSERT_OK(create(spot, "b"));
  const auto refused = create(spot, "c");
  EXPECT_EQ(refused.code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_EQ(refused.reason(), "OUT_OF_QUOTA");
  EXPECT_EQ(locked.Ask(spot, "POST", "/v1/maps", R"({"mapId": "c"})").status, 429) << "nor by the other door";
  ASSERT_OK(create(locked.key_of("robot"), "c"));
  const std::string admin = locked.key_of("admin");
  ASSERT_OK(locked.Call(admin, &MapStub::DeleteMap, About<v1::DeleteMapRequest>("maps/a")));
  EXPECT_OK(create(spot, "d"));
  const auto file = locked.Ask(admin, "GET", "/v1/maps/b:export");
  ASSERT_EQ(file.status, 200);
  for (const char* id : {"e", "f"}) {
    EXPECT_EQ(locked.Ask(admin, "POST", std::string("/v1/maps:import?map_id=") + id, file.body).status, 200);
  }
  EXPECT_EQ(locked.Ask(admin, "POST", "/v1/maps:import?map_id=g", file.body).status, 429);
}

TEST(AttacksOfMakers, APrincipalBeyondItsDiskQuotaMakesAndFeedsNoMap) {
  LockedServer locked({.disk_bytes = 0});
  const std::string robot = locked.key_of("robot");
  EXPECT_EQ(locked.Call(robot, &MapStub::CreateMap, CreateRequest("a")).reason(), "OUT_OF_QUOTA");
}

/// What a key for some maps may import and change.
class AttacksOfNarrowKeys : public ::testing::Test {
 protected:
  AttacksOfNarrowKeys() {
    for (const char* id : {"site-a", "home"}) {
      EXPECT_OK(locked.Call(locked.key_of("robot"), &MapStub::CreateMap, CreateRequest(id)));
    }
  }
  http::HttpAnswer Import(const std::string& key, const std::string& query, const std::string& file) const {
    return locked.Ask(key, "POST", "/v1/maps:import" + query, file);
  }
  std::string Export(const std::string& map) const {
    return locked.Ask(locked.key_of("admin"), "GET", "/v1/maps/" + map + ":export").body;
  }

  LockedServer locked;
  const std::string narrow = locked.MakeKey({.name = "n", .role = auth::Role::kAdmin, .maps = {"site-*"}});
};

TEST_F(AttacksOfNarrowKeys, AnImportedFileOfAForbiddenMapIsDiscarded) {
  const std::string home = Export("home");
  ASSERT_FALSE(home.empty());
  EXPECT_OK(locked.Call(locked.key_of("admin"), &MapStub::DeleteMap, About<v1::DeleteMapRequest>("maps/home")));
  const http::HttpAnswer answer = Import(narrow, "", home);
  EXPECT_EQ(answer.status, 403) << answer.body;
  EXPECT_NE(answer.body.find("MAP_NOT_ALLOWED"), std::string::npos);
  EXPECT_EQ(Import(narrow, "?map_id=other", home).status, 403);
  EXPECT_EQ(locked.Call(locked.key_of("admin"), &MapStub::ListMaps)->maps_size(), 1) << "nothing is kept";
  EXPECT_EQ(Import(narrow, "?map_id=site-b", home).status, 200) << "under a name that it is for";
}

TEST_F(AttacksOfNarrowKeys, NamesWithPathsAreInvalid) {
  const std::string file = Export("site-a"), admin = locked.key_of("admin");
  for (const char* id : {"..%2Fx", "%2e%2e%2fx", "%252e%252e", "..", ".", "a%2Fb", "site-a%00b"}) {
    const http::HttpAnswer answer = Import(admin, std::string("?map_id=") + id, file);
    EXPECT_EQ(answer.status, 400) << id << " " << answer.body;
  }
  EXPECT_EQ(locked.Call(admin, &MapStub::ListMaps)->maps_size(), 2);
}

TEST_F(AttacksOfNarrowKeys, AnEditMayNameOnlyObjectsOfItsMap) {
  for (const char* submap : {"maps/home/submaps/0", "maps/site-a/../home/submaps/0", "maps/home"}) {
    v1::ApplyEditsRequest edit;
    edit.set_map("maps/site-a");
    edit.add_edits()->set_submap(submap);
    edit.mutable_edits(0)->mutable_delete_();
    const auto answer = locked.Call(narrow, &EditStub::ApplyEdits, edit);
    EXPECT_EQ(answer.code(), grpc::INVALID_ARGUMENT) << submap << " " << answer.status().error_message();
  }
}

}  // namespace
}  // namespace dhpmap::testing
