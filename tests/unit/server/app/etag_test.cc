// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/etag.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

MapInfo Info(std::uint64_t history_id, std::string display_name = "") {
  MapInfo info;
  info.history_id = history_id;
  info.display_name = std::move(display_name);
  return info;
}

TEST(Etag, OfASubmapNamesHistoryAndRevision) {
  SubmapInfo row;
  row.revision = 3;
  const Submap submap(row, 1);
  EXPECT_EQ(EtagOf(submap, Info(0x9f)), "000000000000009f-r3");
  EXPECT_NE(EtagOf(submap, Info(1)), EtagOf(submap, Info(2)));
}

TEST(Etag, OfAMapChangesWithItsTitleOnly) {
  MapInfo info = Info(7, "home");
  const std::string before = EtagOf(info);
  info.revision = 9;
  info.num_frames = 100;
  EXPECT_EQ(EtagOf(info), before);
  info.display_name = "office";
  EXPECT_NE(EtagOf(info), before);
  EXPECT_NE(EtagOf(Info(8, "home")), before);
}

TEST(Etag, ThatIsNotThePresentOneAborts) {
  EXPECT_TRUE(CheckEtag("", "a", "submap 7").ok());
  EXPECT_TRUE(CheckEtag("a", "a", "submap 7").ok());
  const Status status = CheckEtag("b", "a", "submap 7");
  EXPECT_EQ(status.code(), StatusCode::kAborted);
  EXPECT_EQ(status.reason(), Reason("ETAG_MISMATCH"));
}

}  // namespace
}  // namespace dhpmap
