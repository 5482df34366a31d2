// SPDX-License-Identifier: BSD-3-Clause
// Lists in pages, and edits of a map itself.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/integration/feeder.h"
#include "tests/integration/test_server.h"

namespace dhpmap::testing {
namespace {

class ListingTest : public ::testing::Test {
 protected:
  v1::Map Create(const std::string& map_id) {
    grpc::ClientContext context;
    v1::CreateMapResponse response;
    status = server.maps->CreateMap(&context, CreateRequest(map_id), &response);
    return response.map();
  }
  v1::ListMapsResponse ListMaps(const v1::ListMapsRequest& request) {
    grpc::ClientContext context;
    v1::ListMapsResponse response;
    status = server.maps->ListMaps(&context, request, &response);
    return response;
  }
  v1::Map Rename(const std::string& name, const std::string& title, const std::string& etag,
                 const std::vector<std::string>& mask) {
    v1::UpdateMapRequest request;
    request.mutable_map()->set_name(name);
    request.mutable_map()->set_display_name(title);
    request.mutable_map()->set_etag(etag);
    for (const std::string& path : mask) request.mutable_update_mask()->add_paths(path);
    grpc::ClientContext context;
    v1::UpdateMapResponse response;
    status = server.maps->UpdateMap(&context, request, &response);
    return response.map();
  }
  grpc::StatusCode Delete(const std::string& name, const std::string& etag) {
    v1::DeleteMapRequest request;
    request.set_name(name);
    request.set_etag(etag);
    grpc::ClientContext context;
    v1::DeleteMapResponse response;
    return server.maps->DeleteMap(&context, request, &response).error_code();
  }

  std::unique_ptr<MapStore> store = MakeMemoryStore();
  TestServer server{*store};
  grpc::Status status;
};

TEST_F(ListingTest, MapsComeInPagesByNameAndWithoutClassesUnlessAskedFor) {
  for (const char* name : {"c", "a", "e", "b", "d"}) Create(name);
  v1::ListMapsRequest request;
  request.set_page_size(2);
  std::string names;
  int num_pages = 0;
  do {
    const v1::ListMapsResponse page = ListMaps(request);
    ASSERT_TRUE(status.ok()) << status.error_message();
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

TEST_F(ListingTest, AMapMadeOrDeletedBetweenPagesMakesNothingComeTwice) {
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

TEST_F(ListingTest, ATokenOfAMapThatWasMadeAnewIsRefused) {
  Create("room");
  ASSERT_TRUE(Feed(server, "room", 0, 4).status.ok());
  v1::ListSubmapsRequest request;
  request.set_parent("maps/room");
  request.set_page_size(1);
  v1::ListSubmapsResponse response;
  {
    grpc::ClientContext context;
    ASSERT_TRUE(server.submaps->ListSubmaps(&context, request, &response).ok());
  }
  ASSERT_EQ(response.submaps_size(), 1);
  request.set_page_token(response.next_page_token());
  EXPECT_EQ(Delete("maps/room", ""), grpc::OK);
  Create("room");
  grpc::ClientContext context;
  EXPECT_EQ(server.submaps->ListSubmaps(&context, request, &response).error_code(), grpc::OUT_OF_RANGE);
}

TEST(ListingAfterACrash, ATokenOfAStateThatWasNotStoredIsRefused) {
  const TempDir folder;
  const std::string path = (folder.path() / "maps.db").string(), crashed = (folder.path() / "crashed.db").string();
  const auto store = std::move(OpenSqliteStore(path)).value();
  TestServer server(*store, {.publish_frames = 1, .commit_frames = 1000, .commit_s = 1000});
  v1::ListSubmapsRequest request;
  request.set_parent("maps/room");
  request.set_page_size(1);
  // The token of the next page, as `from` answers it.
  const auto list = [&request](TestServer& from, std::string& token) {
    grpc::ClientContext context;
    v1::ListSubmapsResponse page;
    const grpc::Status status = from.submaps->ListSubmaps(&context, request, &page);
    token = page.next_page_token();
    return status;
  };
  grpc::ClientContext create;
  v1::CreateMapResponse made;
  ASSERT_TRUE(server.maps->CreateMap(&create, CreateRequest("room"), &made).ok());
  ASSERT_TRUE(Feed(server, "room", 0, 2).status.ok());  // stored with the end of the stream
  std::string stored, seen, next;
  ASSERT_TRUE(list(server, stored).ok());
  Feeder feeder(server, "room");
  ASSERT_TRUE(feeder.Feed(2));
  ASSERT_TRUE(list(server, seen).ok());
  ASSERT_NE(seen, stored);
  for (const char* part : {"", "-wal"}) std::filesystem::copy_file(path + part, crashed + part);  // it is killed here

  const auto reopened = std::move(OpenSqliteStore(crashed)).value();
  TestServer after(*reopened);
  request.set_page_token(stored);
  EXPECT_TRUE(list(after, next).ok());
  request.set_page_token(seen);
  const grpc::Status refused = list(after, next);
  EXPECT_EQ(refused.error_code(), grpc::OUT_OF_RANGE);
  EXPECT_EQ(ReasonOf(refused), "HISTORY_LOST");
}

TEST_F(ListingTest, AMapIsRenamedWhereItsEtagIsThePresentOne) {
  const v1::Map made = Create("room");
  EXPECT_EQ(made.history_id().size(), 16u);
  const v1::Map named = Rename("maps/room", "Kitchen", made.etag(), {"display_name"});
  ASSERT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(named.display_name(), "Kitchen");
  EXPECT_NE(named.etag(), made.etag());
  EXPECT_EQ(named.history_id(), made.history_id());
  Rename("maps/room", "x", made.etag(), {"*"});
  EXPECT_EQ(status.error_code(), grpc::ABORTED);
  Rename("maps/room", "x", "", {"config"});
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(Rename("maps/room", "", "", {"*"}).display_name(), "");
  ASSERT_TRUE(Feed(server, "room", 0, 2).status.ok());
  EXPECT_EQ(Rename("maps/room", "", "", {}).etag(), made.etag()) << "frames leave it alone";
}

TEST_F(ListingTest, AMapIsDeletedWhereItsEtagIsThePresentOne) {
  const v1::Map made = Create("room");
  Rename("maps/room", "Kitchen", "", {});
  EXPECT_EQ(Delete("maps/room", made.etag()), grpc::ABORTED);
  EXPECT_EQ(Delete("maps/room", Rename("maps/room", "Kitchen", "", {}).etag()), grpc::OK);
}

}  // namespace
}  // namespace dhpmap::testing
