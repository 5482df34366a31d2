// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "clients/cli/doctor/examination.h"
#include "clients/cli/doctor/judge.h"

namespace dhpmap {
namespace {

constexpr std::int64_t kNow_s = 1'800'000'000, kDay_s = 86'400, kGibibyte = std::int64_t{1} << 30;

/// What is not well comes with what to do, and what is well without.
void ExpectHealth(const Finding& finding, Health health) {
  EXPECT_EQ(finding.health, health) << finding.what << ": " << finding.text;
  EXPECT_NE(finding.text, "");
  EXPECT_EQ(finding.advice.empty(), health == Health::kOk) << finding.what << ": " << finding.advice;
}

TEST(Doctor, VersionsAgreeByTheirMinor) {
  ExpectHealth(JudgeVersion("0.2.0", "0.2.7"), Health::kOk);
  ExpectHealth(JudgeVersion("0.2.0", "0.3.0"), Health::kWarn);
  ExpectHealth(JudgeVersion("1.2.0", "0.2.0"), Health::kWarn);
  ExpectHealth(JudgeVersion("0.2.0", ""), Health::kWarn);
}

TEST(Doctor, ACertificateIsToBeRenewedInTime) {
  CertificateSight sight{.is_reached = true, .is_tls = true, .expires_s = kNow_s + 15 * kDay_s};
  ExpectHealth(JudgeCertificate(sight, kNow_s), Health::kOk);
  EXPECT_NE(JudgeCertificate(sight, kNow_s).text.find("15 days"), std::string::npos);
  sight.expires_s = kNow_s + 13 * kDay_s;
  ExpectHealth(JudgeCertificate(sight, kNow_s), Health::kWarn);
  sight.fault = "certificate has expired";
  sight.is_expired = true;
  ExpectHealth(JudgeCertificate(sight, kNow_s), Health::kFail);
  const std::string when_expired = JudgeCertificate(sight, kNow_s).advice;
  sight.is_expired = false;
  sight.is_of_other_name = true;
  EXPECT_NE(JudgeCertificate(sight, kNow_s).advice, when_expired);
  ExpectHealth(JudgeCertificate({.is_reached = true}, kNow_s), Health::kFail);
}

TEST(Doctor, AClockIsOffOnlyByMoreThanCanBeKnown) {
  ExpectHealth(JudgeClock(0.001, 0.002), Health::kOk);
  ExpectHealth(JudgeClock(3, 2.5), Health::kOk);  // the answer took five seconds
  for (const double sign : {-1.0, 1.0}) {
    ExpectHealth(JudgeClock(sign * 0.9, 0.01), Health::kOk);
    ExpectHealth(JudgeClock(sign * 1.1, 0.01), Health::kWarn);
    ExpectHealth(JudgeClock(sign * 61, 0.01), Health::kFail);
  }
  EXPECT_NE(JudgeClock(5, 0).text.find("ahead of"), std::string::npos);
  EXPECT_NE(JudgeClock(-5, 0).text.find("behind"), std::string::npos);
}

TEST(Doctor, ADiskIsToHaveRoomForWhatComesAndForTheCopyOfAnUpgrade) {
  ExpectHealth(JudgeDisk(50 * kGibibyte, 100 * kGibibyte, 20 * kGibibyte), Health::kOk);
  ExpectHealth(JudgeDisk(19 * kGibibyte, 100 * kGibibyte, 20 * kGibibyte), Health::kWarn);
  ExpectHealth(JudgeDisk(kGibibyte / 2, 100 * kGibibyte, 0), Health::kWarn);
  ExpectHealth(JudgeDisk(kGibibyte / 5, 100 * kGibibyte, 0), Health::kFail);
  ExpectHealth(JudgeDisk(-1, -1, 0), Health::kWarn);
}

TEST(Doctor, SavingLagsBeforeFramesAreRefused) {
  ExpectHealth(JudgeSaving(0, 30), Health::kOk);
  ExpectHealth(JudgeSaving(2, 30), Health::kOk);
  ExpectHealth(JudgeSaving(16, 30), Health::kWarn);
  ExpectHealth(JudgeSaving(31, 30), Health::kFail);
  ExpectHealth(JudgeReadiness(true), Health::kOk);
  ExpectHealth(JudgeReadiness(false), Health::kFail);
}

TEST(Doctor, EachFeedThatIsNotWellIsNamed) {
  const client::ActiveFeed well{.map = "hall", .session = "anna", .num_frames = 1000, .frames_per_s = 10};
  client::ActiveFeed silent = well, refused = well;
  silent.session = "bert";
  silent.silent_s = 9;
  refused.session = "";
  refused.num_refused = 100;
  const auto one_for_all = JudgeFeeds({well, well});
  ASSERT_EQ(one_for_all.size(), 1u);
  ExpectHealth(one_for_all[0], Health::kOk);
  EXPECT_NE(one_for_all[0].text.find("20.0 frames/s"), std::string::npos) << one_for_all[0].text;
  const auto each = JudgeFeeds({well, silent, refused});
  ASSERT_EQ(each.size(), 2u);
  for (const Finding& finding : each) ExpectHealth(finding, Health::kWarn);
  EXPECT_NE(each[0].text.find("bert"), std::string::npos) << each[0].text;
  EXPECT_NE(each[1].text.find("100 of 1100"), std::string::npos) << each[1].text;
  ASSERT_EQ(JudgeFeeds({}).size(), 1u);
  ExpectHealth(JudgeFeeds({})[0], Health::kOk);
}

TEST(Doctor, SaysHowToMendAFeedOfFramesWithWarnings) {
  client::ActiveFeed feed{.map = "hall",
                          .session = "anna",
                          .num_frames = 30,
                          .num_implausible = 20,
                          .last_fault = "TRANSLATION_IN_MILLIMETRES",
                          .last_warning = "the translation looks like millimetres"};
  const auto judged = [&feed] { return JudgeFeeds({feed}).at(0); };
  ExpectHealth(judged(), Health::kWarn);
  EXPECT_NE(judged().text.find("20 of 30 frames"), std::string::npos) << judged().text;
  EXPECT_NE(judged().text.find(feed.last_warning), std::string::npos) << judged().text;
  EXPECT_NE(judged().advice.find("divide"), std::string::npos) << judged().advice;
  feed.num_refused = 20;
  EXPECT_NE(judged().advice.find("divide"), std::string::npos) << "why they are refused is more than that they are";
  feed.num_refused = 0;
  feed.last_fault = "A_FAULT_OF_A_LATER_SERVER";
  EXPECT_FALSE(judged().advice.empty());
  feed.num_plausible_since = 99;
  ExpectHealth(judged(), Health::kWarn);
  feed.num_plausible_since = 100;
  ExpectHealth(judged(), Health::kOk);
}

TEST(Doctor, TellsTheWorstAndPrintsALineEach) {
  const Finding ok{.what = "clock", .text = "right"};
  const Finding warn{.health = Health::kWarn, .what = "disk", .text = "full\x1b[31m \"soon\"", .advice = "make room"};
  EXPECT_EQ(WorstOf({}), Health::kOk);
  EXPECT_EQ(WorstOf({ok, warn, ok}), Health::kWarn);
  EXPECT_EQ(WorstOf({warn, {.health = Health::kFail}, ok}), Health::kFail);
  const std::string text = FindingsText({ok, warn});
  EXPECT_TRUE(text.starts_with("ok    clock: right\nwarn  disk: ")) << text;
  EXPECT_TRUE(text.ends_with("\n      make room\n")) << text;
  EXPECT_EQ(text.find('\x1b'), std::string::npos) << "what a server says does not colour a terminal";
  const std::string json = FindingsJson({ok, warn});
  EXPECT_NE(json.find("\"health\": \"warn\",\n"), std::string::npos) << json;
  EXPECT_NE(json.find("\\\"soon\\\""), std::string::npos) << json;
}

}  // namespace
}  // namespace dhpmap
