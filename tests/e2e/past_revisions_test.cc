// SPDX-License-Identifier: BSD-3-Clause
// The recent past over REST, of a server that keeps little of it.
#include <gtest/gtest.h>

#include <string>

#include "tests/e2e/rest_fixture.h"

namespace dhpmap::testing {
namespace {

class RestPast : public RestTest {
 protected:
  void SetUp() override {
    Start({{"DHPMAP_HISTORY_KEPT_STATES", "2"}});
    Create("room");
    first_ = RevisionOf("/v1/maps/room");
    for (const char* title : {"a", "b", "c"}) {
      const http::HttpAnswer renamed =
          Ask("PATCH", "/v1/maps/room", std::string(R"({"display_name":")") + title + "\"}");
      ASSERT_EQ(renamed.status, 200) << renamed.body;
    }
  }
  [[nodiscard]] std::int64_t RevisionOf(const std::string& target) const {
    v1::GetMapResponse response;
    const http::HttpAnswer answer = Ask("GET", target);
    EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(answer.body, &response).ok()) << answer.body;
    return response.map().revision();
  }
  [[nodiscard]] static bool Has(const http::HttpAnswer& answer, const std::string& part) {
    return answer.body.find(part) != std::string::npos;
  }
  [[nodiscard]] std::string At(const std::string& target, std::int64_t revision) const {
    return "/v1/maps/room" + target + "?read_revision=" + std::to_string(revision);
  }

  std::int64_t first_ = 0;
};

TEST_F(RestPast, IsReadByGetAndByPost) {
  EXPECT_EQ(RevisionOf(At("", first_ + 2)), first_ + 2);
  const http::HttpAnswer past = Ask("GET", At("", first_ + 2));
  EXPECT_TRUE(Has(past, "\"b\"")) << past.body;
  const std::string body = R"({"points_m":[{"x":1}],"read_revision":")" + std::to_string(first_ + 2) + "\"}";
  const http::HttpAnswer posted = Ask("POST", "/v1/maps/room:queryPoints", body);
  EXPECT_EQ(posted.status, 200) << posted.body;
  EXPECT_TRUE(Has(posted, "\"revision\"")) << posted.body;
}

TEST_F(RestPast, WhatIsKeptNoLongerIsGone) {
  for (const char* target : {"", "/submaps", "/stats", "/ignoredRegions"}) {
    const http::HttpAnswer gone = Ask("GET", At(target, first_));
    EXPECT_EQ(gone.status, 410) << target << ": " << gone.body;
    EXPECT_TRUE(Has(gone, "REVISION_NOT_KEPT")) << gone.body;
    EXPECT_TRUE(Has(gone, "\"revision_after\"")) << gone.body;
    EXPECT_TRUE(Has(gone, std::to_string(first_ + 2))) << "where to go on: " << gone.body;
    const http::HttpAnswer future = Ask("GET", At(target, first_ + 9));
    EXPECT_EQ(future.status, 400) << target << ": " << future.body;
    EXPECT_TRUE(Has(future, "BAD_REVISION")) << future.body;
  }
  EXPECT_EQ(Ask("GET", "/v1/maps/room?read_revision=yesterday").status, 400);
}

TEST_F(RestPast, IsRestored) {
  const auto restore = [this](std::int64_t revision) {
    return Ask("POST", "/v1/maps/room:restoreRevision", R"({"revision":")" + std::to_string(revision) + "\"}");
  };
  const http::HttpAnswer gone = restore(first_);
  EXPECT_EQ(gone.status, 410) << gone.body;
  EXPECT_TRUE(Has(gone, "REVISION_NOT_KEPT")) << gone.body;
  const http::HttpAnswer restored = restore(first_ + 2);
  EXPECT_EQ(restored.status, 200) << restored.body;
  EXPECT_EQ(RevisionOf("/v1/maps/room"), first_ + 4);
  EXPECT_TRUE(Has(Ask("GET", "/v1/maps/room"), "\"b\""));
  EXPECT_TRUE(Has(Ask("GET", "/v1/maps/room/edits"), "RESTORE"));
}

}  // namespace
}  // namespace dhpmap::testing
