// SPDX-License-Identifier: BSD-3-Clause
#include "server/http/message.h"

#include <gtest/gtest.h>

#include "mapping/base/reason.h"
#include "proto/types/http_status.h"

namespace dhpmap::http {
namespace {

TEST(FindHeader, FindsTheFirstIgnoringCase) {
  const Headers headers = {{"Accept", "a"}, {"ACCEPT", "b"}, {"X", ""}};
  EXPECT_EQ(FindHeader(headers, "accept"), "a");
  EXPECT_EQ(FindHeader(headers, "x"), "");
  EXPECT_EQ(FindHeader(headers, "missing"), "");
}

TEST(EqualsIgnoringCase, FoldsAsciiLettersOnly) {
  EXPECT_TRUE(EqualsIgnoringCase("Content-LENGTH", "content-length"));
  EXPECT_FALSE(EqualsIgnoringCase("a", "ab"));
  EXPECT_FALSE(EqualsIgnoringCase("@", "`")) << "32 apart, and no letters";
  EXPECT_FALSE(EqualsIgnoringCase("\xC4", "\xE4"));
}

TEST(ReasonPhrase, IsKnownForEverySentStatus) {
  for (const int status : {200, 204, 400, 401, 403, 404, 405, 409, 413, 415, 421, 429, 431, 499, 500, 501, 503, 504}) {
    EXPECT_NE(ReasonPhrase(status), "Unknown") << status;
  }
  for (const ReasonStatusRow& row : ReasonStatusTable()) {
    EXPECT_NE(ReasonPhrase(row.http_status), "Unknown") << row.reason;
  }
  EXPECT_EQ(ReasonPhrase(410), "Gone");
  EXPECT_EQ(ReasonPhrase(299), "Unknown");
}

}  // namespace
}  // namespace dhpmap::http
