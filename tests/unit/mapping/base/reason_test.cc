// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/reason.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

namespace dhpmap {
namespace {

TEST(Reason, EveryRowHasItsOwnNameACodeOfAnErrorAndAMeaning) {
  std::set<std::string_view> names;
  for (const ReasonRow& row : kReasonTable) {
    EXPECT_TRUE(std::regex_match(std::string(row.name), std::regex("[A-Z]+(_[A-Z]+)*"))) << row.name;
    EXPECT_TRUE(names.insert(row.name).second) << row.name << " stands twice";
    EXPECT_FALSE(row.meaning.empty()) << row.name;
  }
}

TEST(Reason, IsFoundByTheNameItShows) {
  for (const ReasonRow& row : kReasonTable) EXPECT_EQ(Reason::Find(row.name).name(), row.name);
  EXPECT_TRUE(Reason::Find("NOT_IN_THE_TABLE").empty());
  EXPECT_TRUE(Reason::Find("").empty());
  EXPECT_EQ(Reason::Find("MAP_NOT_FOUND"), Reason("MAP_NOT_FOUND"));
  EXPECT_NE(Reason("MAP_EXISTS"), Reason("MAP_NOT_FOUND"));
  EXPECT_EQ(Reason(), Reason::Find("NOT_IN_THE_TABLE"));
}

TEST(Reason, ComesWithTheCodeOfItsRow) {
  EXPECT_TRUE(Reason("MAP_NOT_FOUND").Allows(StatusCode::kNotFound));
  EXPECT_FALSE(Reason("MAP_NOT_FOUND").Allows(StatusCode::kInternal));
  EXPECT_TRUE(Reason("NOT_STORED").Allows(StatusCode::kResourceExhausted)) << "it takes the code of its cause";
  EXPECT_TRUE(Reason().Allows(StatusCode::kInternal));
}

}  // namespace
}  // namespace dhpmap
