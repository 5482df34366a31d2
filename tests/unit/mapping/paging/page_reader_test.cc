// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/paging/page_reader.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

#include "mapping/base/status_error.h"
#include "tests/support/eventually.h"

namespace dhpmap {
namespace {

class PageReaderTest : public ::testing::Test {
 protected:
  ~PageReaderTest() override { SetPageReaderLimit({}); }
  /// Reads one as the calling thread; whether it may.
  static Status Read(std::int64_t bytes) {
    try {
      PageReader::Admit();
    } catch (const StatusError& error) {
      return error.status();
    }
    PageReader::Count(bytes);
    return Status::Ok();
  }
};

TEST_F(PageReaderTest, ARequestMayHoldSoMuchAndIsToldBeyond) {
  SetPageReaderLimit({.bytes = 100, .wait_s = 60});
  {
    const PageReader request;
    for (int n = 0; n < 4; ++n) ASSERT_TRUE(Read(30).ok()) << n;
    EXPECT_EQ(PageReaderBytes(), 120) << "one tile beyond at most";
    const Status refused = Read(30);  // at once: nobody else holds anything
    EXPECT_EQ(refused.code(), StatusCode::kResourceExhausted);
    EXPECT_EQ(refused.reason(), Reason("OVER_MEMORY_BUDGET"));
    EXPECT_NE(refused.message().find("ask for less"), std::string::npos);
  }
  EXPECT_EQ(PageReaderBytes(), 0);
  const PageReader next;
  EXPECT_TRUE(Read(30).ok());
}

TEST_F(PageReaderTest, WhereOthersHoldItTheirEndIsWaitedFor) {
  SetPageReaderLimit({.bytes = 100, .wait_s = 600});
  auto held = std::make_unique<PageHold>();
  {
    const PageReader stream(*held);
    ASSERT_TRUE(Read(100).ok());
  }
  EXPECT_EQ(PageReaderBytes(), 100) << "the stream goes on";
  std::atomic<bool> is_admitted = false;
  std::thread other([&] {
    const PageReader request;
    is_admitted = Read(50).ok();
  });
  EXPECT_TRUE(testing::Eventually([] { return NumPageReadersWaiting() == 1; }));
  EXPECT_FALSE(is_admitted);
  held = nullptr;
  other.join();
  EXPECT_TRUE(is_admitted);
  EXPECT_EQ(PageReaderBytes(), 0);
}

TEST_F(PageReaderTest, NobodyWaitsForEver) {
  SetPageReaderLimit({.bytes = 100, .wait_s = 0.01});
  PageHold held;
  {
    const PageReader stream(held);
    ASSERT_TRUE(Read(100).ok());
  }
  const PageReader request;
  const Status refused = Read(1);
  EXPECT_EQ(refused.reason(), Reason("OVER_MEMORY_BUDGET"));
  EXPECT_NE(refused.message().find("try again later"), std::string::npos);
}

TEST_F(PageReaderTest, WhatFusesAndWhatPassesIsNotBounded) {
  SetPageReaderLimit({.bytes = 100, .wait_s = 0});
  for (int n = 0; n < 10; ++n) ASSERT_TRUE(Read(100).ok()) << "no request";
  EXPECT_EQ(PageReaderBytes(), 0);
  const PageReader request;
  ASSERT_TRUE(Read(100).ok());
  {
    const PageReader::Passing passing;
    EXPECT_TRUE(Read(1000).ok());
  }
  EXPECT_EQ(PageReaderBytes(), 100);
  EXPECT_FALSE(Read(1).ok());
}

TEST_F(PageReaderTest, OthersWhoReadForARequestCountForIt) {
  SetPageReaderLimit({.bytes = 100, .wait_s = 0});
  const PageReader request;
  PageHold* const hold = PageReader::Current();
  ASSERT_NE(hold, nullptr);
  std::thread helper([hold] {
    EXPECT_EQ(PageReader::Current(), nullptr);
    const PageReader reading(hold);
    EXPECT_TRUE(Read(100).ok());
    EXPECT_FALSE(Read(1).ok());
  });
  helper.join();
  EXPECT_EQ(PageReaderBytes(), 100);
  EXPECT_NE(Read(1).message().find("ask for less"), std::string::npos) << "it is its own";
}

TEST_F(PageReaderTest, WithoutALimitThereIsNone) {
  const PageReader request;
  for (int n = 0; n < 10; ++n) EXPECT_TRUE(Read(std::int64_t{1} << 40).ok());
}

}  // namespace
}  // namespace dhpmap
