// SPDX-License-Identifier: BSD-3-Clause
// Lists in pages, and edits of a map itself.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "storage/sqlite_store.h"
#include "tests/integration/feeder.h"
#include "tests/integration/test_server.h"

namespace dhpmap::testing {
namespace {

class ListingTest : public ::testing::Test {
 protected:
  v1::Map Create(const std::string& map_id) {
    return server.Call(&MapStub::CreateMap, CreateRequest(map_id)).KeepStatus(status).map();
  }
  v1::ListMapsResponse ListMaps(const v1::ListMapsRequest& request) {
    return server.Call(&MapStub::ListMaps, request).KeepStatus(status);
  }
  v1::Map Rename(const std::string& name, const std::string& title, const std::string& etag,
                 const std::vector<std::string>& mask) {
    v1::UpdateMapRequest request;
    request.mutable_map()->set_name(name);
    request.mutable_map()->set_display_name(title);
    request.mutable_map()->set_etag(etag);
    for (const std::string& path : mask) request.mutable_update_mask()->add_paths(path);
    return server.Call(&MapStub::UpdateMap, request).KeepStatus(status).map();
  }
  grpc::StatusCode Delete(const std::string& name, const std::string& etag) {
    v1::DeleteMapRequest request;
    request.set_name(name);
    request.set_etag(etag);
    return server.Call(&MapStub::DeleteMap, request).code();
  }

  std::unique_ptr<MapStore> store = MakeMemoryStore();
  TestServer server{*store};
  grpc::Status status;
};

TEST_F(ListingTest, MapsAreListedInPagesByNameWithClassesOnRequest) {
  for (const char* name : {"c", "a", "e", "b", "d"}) Create(name);
  v1::ListMapsRequest request;
  request.set_page_size(2);
  std::string names;
  int num_pages = 0;
  do {
    const v1::ListMapsResponse page = ListMaps(request);
    ASSERT_OK(status);
    for (const v1::Map& map : page.maps()) {
      names += map.name().substr(5);
      EXPECT_EQ(map.label_classes_size(), 0);
    }
    request.set_page_token(page.next_page_token());
    ++num_pages;
  } while (!request.page_token().empty());
  EXPECT_EQ(names, "abcde");
  EXPECT_EQ(num_pages, 3);
  request.set_include_label_classes(true);
  EXPECT_GT(ListMaps(request).maps(0).label_classes_size(), 0);
}

TEST_F(ListingTest, CreatingOrDeletingAMapBetweenPagesRepeatsNothing) {
  for (const char* name : {"b", "d", "f"}) Create(name);
  v1::ListMapsRequest request;
  request.set_page_size(2);
  request.set_page_token(ListMaps(request).next_page_token());
  Create("a");
  Create("e");
  EXPECT_EQ(Delete("maps/d", ""), grpc::OK);
  const v1::ListMapsResponse rest = ListMaps(request);
  ASSERT_EQ(rest.maps_size(), 2);
  EXPECT_EQ(rest.maps(0).name(), "maps/e");
  EXPECT_EQ(rest.maps(1).name(), "maps/f");
}

TEST_F(ListingTest, ATokenOfARecreatedMapIsRefused) {
  Create("room");
  ASSERT_OK(Feed(server, "room", 0, 4));
  v1::ListSubmapsRequest request;
  request.set_parent("maps/room");
  request.set_page_size(1);
  ASSERT_OK_AND_ASSIGN(const auto response, server.Call(&SubmapStub::ListSubmaps, request));
  ASSERT_EQ(response.submaps_size(), 1);
  request.set_page_token(response.next_page_token());
  EXPECT_EQ(Delete("maps/room", ""), grpc::OK);
  Create("room");
  EXPECT_EQ(server.Call(&SubmapStub::ListSubmaps, request).code(), grpc::OUT_OF_RANGE);
}

TEST(ListingAfterACrash, ATokenOfAnUnstoredStateIsRefused) {
  const TempDir folder;
  const std::string path = (folder.path() / "maps.db").string(), crashed = (folder.path() / "crashed.db").string();
  const auto store = std::move(OpenSqliteStore(path)).value();
  TestServer server(*store, {.publish = {.frames = 1}, .commit = {.frames = 1000, .delay_s = 1000}});
  v1::ListSubmapsRequest request;
  request.set_parent("maps/room");
  request.set_page_size(1);
  // Lists at `from`; `token` becomes the token of the next page.
  const auto list = [&request](TestServer& from, std::string& token) {
    const auto page = from.Call(&SubmapStub::ListSubmaps, request);
    token = page->next_page_token();
    return page.status();
  };
  ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
  ASSERT_OK(Feed(server, "room", 0, 2));  // stored at the end of the stream
  std::string stored, seen, next;
  ASSERT_OK(list(server, stored));
  Feeder feeder(server, "room");
  ASSERT_TRUE(feeder.Feed(2));
  ASSERT_OK(list(server, seen));
  ASSERT_NE(seen, stored);
  for (const char* part : {"", "-wal"}) std::filesystem::copy_file(path + part, crashed + part);  // as after a kill

  const auto reopened = std::move(OpenSqliteStore(crashed)).value();
  TestServer after(*reopened);
  request.set_page_token(stored);
  EXPECT_OK(list(after, next));
  request.set_page_token(seen);
  const grpc::Status refused = list(after, next);
  EXPECT_EQ(refused.error_code(), grpc::OUT_OF_RANGE);
  EXPECT_EQ(ReasonOf(refused), "HISTORY_LOST");
}

TEST_F(ListingTest, AMapIsRenamedOnlyWithItsPresentEtag) {
  const v1::Map made = Create("room");
  EXPECT_EQ(made.history_id().size(), 16u);
  const v1::Map named = Rename("maps/room", "Kitchen", made.etag(), {"display_name"});
  ASSERT_OK(status);
  EXPECT_EQ(named.display_name(), "Kitchen");
  EXPECT_NE(named.etag(), made.etag());
  EXPECT_EQ(named.history_id(), made.history_id());
  Rename("maps/room", "x", made.etag(), {"*"});
  EXPECT_EQ(status.error_code(), grpc::ABORTED);
  Rename("maps/room", "x", "", {"config"});
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(Rename("maps/room", "", "", {"*"}).display_name(), "");
  ASSERT_OK(Feed(server, "room", 0, 2));
  EXPECT_EQ(Rename("maps/room", "", "", {}).etag(), made.etag()) << "frames leave it alone";
}

TEST_F(ListingTest, AMapIsDeletedOnlyWithItsPresentEtag) {
  const v1::Map made = Create("room");
  Rename("maps/room", "Kitchen", "", {});
  EXPECT_EQ(Delete("maps/room", made.etag()), grpc::ABORTED);
  EXPECT_EQ(Delete("maps/room", Rename("maps/room", "Kitchen", "", {}).etag()), grpc::OK);
}

}  // namespace
}  // namespace dhpmap::testing
