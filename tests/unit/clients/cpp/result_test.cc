// SPDX-License-Identifier: BSD-3-Clause
#include "dhpmap/result.h"

#include <gtest/gtest.h>

#include <memory>
#include <type_traits>
#include <vector>

namespace dhpmap::testing {
namespace {

using Numbers = client::Result<std::vector<std::shared_ptr<int>>>;

Numbers Make(const std::shared_ptr<int>& number) { return std::vector<std::shared_ptr<int>>{number}; }

TEST(ClientResult, WhatATemporaryHoldsOutlivesIt) {
  static_assert(!std::is_reference_v<decltype(Make({}).value())>);
  static_assert(!std::is_reference_v<decltype(*Make({}))>);
  const auto number = std::make_shared<int>(7);
  for (const std::shared_ptr<int>& its : Make(number).value()) EXPECT_EQ(its.use_count(), 2);
  for (const std::shared_ptr<int>& its : *Make(number)) EXPECT_EQ(its.use_count(), 2);
  EXPECT_EQ(number.use_count(), 1);
}

TEST(ClientResult, ValueThrowsTheStatusWhereThereIsNone) {
  const client::Status gone{client::StatusCode::kNotFound, "gone", "MAP_NOT_FOUND", {}, {}};
  try {
    (void)Numbers(gone).value();
    FAIL() << "it has none";
  } catch (const client::BadResult& bad) {
    EXPECT_EQ(bad.status().reason, "MAP_NOT_FOUND");
    EXPECT_STREQ(bad.what(), "NOT_FOUND: gone (MAP_NOT_FOUND)");
  }
}

}  // namespace
}  // namespace dhpmap::testing
