// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/states/etag.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

MapInfo Info(std::uint64_t history_id, std::string display_name = "") {
  MapInfo info;
  info.history_id = history_id;
  info.display_name = std::move(display_name);
  return info;
}

SubmapInfo RowWith(std::uint32_t id, std::int64_t revision, std::int64_t edited_revision) {
  SubmapInfo row;
  row.id = SubmapId(id);
  row.revision = revision;
  row.edited_revision = edited_revision;
  return row;
}

TEST(Etag, OfASubmapNamesHistoryAndSubmapAndItsLastChangeAndEdit) {
  EXPECT_EQ(EtagOf(Submap(RowWith(7, 12, 5), 1), Info(0x9f)), "000000000000009f-s7-r12-e5");
  EXPECT_NE(EtagOf(RowWith(7, 12, 5), Info(1)), EtagOf(RowWith(7, 12, 5), Info(2)));
  EXPECT_NE(EtagOf(RowWith(7, 12, 5), Info(1)), EtagOf(RowWith(8, 12, 5), Info(1)));
}

TEST(Etag, FromBeforeFramesIsValidForAnEdit) {
  const std::string before = EtagOf(RowWith(7, 12, 5), Info(1));
  EXPECT_NE(EtagOf(RowWith(7, 20, 5), Info(1)), before) << "whoever keeps what was read must see that it changed";
  EXPECT_TRUE(CheckEtag(before, RowWith(7, 20, 5), Info(1)).ok());
  EXPECT_TRUE(CheckEtag("", RowWith(7, 20, 5), Info(1)).ok());
}

TEST(Etag, FromBeforeAnEditOrOfAnotherSubmapOrHistoryAbortsAnEdit) {
  const std::string known = EtagOf(RowWith(7, 12, 5), Info(1));
  const auto reason_of = [](const std::string& etag, const SubmapInfo& now, const MapInfo& map) {
    return CheckEtag(etag, now, map).reason();
  };
  EXPECT_EQ(reason_of(known, RowWith(7, 13, 13), Info(1)), Reason("ETAG_MISMATCH"));
  EXPECT_EQ(reason_of(known, RowWith(8, 12, 5), Info(1)), Reason("ETAG_MISMATCH"));
  EXPECT_EQ(reason_of(known, RowWith(7, 12, 5), Info(2)), Reason("ETAG_MISMATCH"));
  for (const char* tail : {"-s7-r12", "-s7-r-e5", "-s7-r12x-e5", "-s7-r-1-e5", "-s77-r12-e5", "-s7-r12-e15", "-r12"}) {
    EXPECT_EQ(reason_of(HistoryText(1) + tail, RowWith(7, 12, 5), Info(1)), Reason("ETAG_MISMATCH")) << tail;
  }
}

TEST(Etag, OfALostStateAbortsEveryLaterEdit) {
  const std::string lost = EtagOf(RowWith(7, 12, 5), Info(1));
  EXPECT_EQ(CheckEtag(lost, RowWith(7, 10, 5), Info(1)).reason(), Reason("ETAG_MISMATCH")) << "as it is stored";
  const LostRevisions ranges = {{11, 1000}};
  EXPECT_EQ(CheckEtag(lost, RowWith(7, 1001, 5), Info(1), ranges).reason(), Reason("ETAG_MISMATCH"))
      << "and seen again";
  EXPECT_TRUE(CheckEtag(EtagOf(RowWith(7, 10, 5), Info(1)), RowWith(7, 1001, 5), Info(1), ranges).ok());
}

TEST(Etag, ALostRevisionIsOutOfRange) {
  const LostRevisions ranges = {{11, 1000}};
  for (const std::int64_t revision : {0, 10, 1001}) {
    EXPECT_TRUE(CheckNotLost(revision, ranges, Info(1), "f").ok()) << revision;
  }
  for (const std::int64_t revision : {11, 1000}) {
    const Status status = CheckNotLost(revision, ranges, Info(1), "f");
    EXPECT_EQ(status.code(), StatusCode::kOutOfRange);
    EXPECT_EQ(status.reason(), Reason("HISTORY_LOST"));
    ASSERT_EQ(status.violations().size(), 1u);
    EXPECT_EQ(status.violations()[0].field, "f");
  }
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

TEST(Etag, OfAnEarlierStateAborts) {
  EXPECT_TRUE(CheckEtag("", "a", "submap 7").ok());
  EXPECT_TRUE(CheckEtag("a", "a", "submap 7").ok());
  const Status status = CheckEtag("b", "a", "submap 7");
  EXPECT_EQ(status.code(), StatusCode::kAborted);
  EXPECT_EQ(status.reason(), Reason("ETAG_MISMATCH"));
}

}  // namespace
}  // namespace dhpmap
