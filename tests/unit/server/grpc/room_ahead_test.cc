// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/room_ahead.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace dhpmap {
namespace {

std::shared_ptr<ByteBudget> BudgetOf(std::size_t bytes) { return std::make_shared<ByteBudget>(bytes); }

TEST(RoomAhead, IsReservedBeforeTheMessageAndResizedWithIt) {
  const auto budget = BudgetOf(100);
  RoomAhead room(budget);
  ASSERT_TRUE(room.Take(60));
  EXPECT_EQ(budget->used_bytes(), 60u);
  ASSERT_TRUE(room.Use(90));
  EXPECT_EQ(budget->used_bytes(), 90u);
  ASSERT_TRUE(room.Use(10));
  EXPECT_EQ(room.bytes(), 10u);
  room.Release();
  EXPECT_EQ(budget->used_bytes(), 0u);
}

TEST(RoomAhead, ARefusedReservationHoldsNothing) {
  const auto budget = BudgetOf(100);
  RoomAhead first(budget), second(budget);
  ASSERT_TRUE(first.Take(60));
  EXPECT_FALSE(second.Take(60));
  EXPECT_EQ(second.bytes(), 0u);
  ASSERT_TRUE(second.Use(40));
  EXPECT_FALSE(second.Use(41));
  EXPECT_EQ(second.bytes(), 0u);
  EXPECT_EQ(budget->used_bytes(), 60u);
}

TEST(RoomAhead, ForAMessageLargerThanTheBudgetTakesAllOfIt) {
  const auto budget = BudgetOf(100);
  RoomAhead room(budget);
  ASSERT_TRUE(room.Take(1000));
  EXPECT_EQ(budget->used_bytes(), 100u);
  EXPECT_FALSE(room.Use(1000)) << "once it is there it is counted as it is";
  EXPECT_EQ(budget->used_bytes(), 0u);
}

TEST(RoomAhead, IsReturnedOnlyIfNoMessageHasArrived) {
  const auto budget = BudgetOf(100);
  RoomAhead room(budget);
  ASSERT_TRUE(room.Take(60));
  room.GiveBackUnused();
  EXPECT_EQ(budget->used_bytes(), 0u);
  ASSERT_TRUE(room.Take(60));
  ASSERT_TRUE(room.Use(70));
  room.GiveBackUnused();
  EXPECT_EQ(budget->used_bytes(), 70u);
}

TEST(RoomAhead, EndsWithItsStreamBeforeTheBudget) {
  auto budget = BudgetOf(100);
  const std::weak_ptr<ByteBudget> watched = budget;
  {
    RoomAhead room(std::move(budget));
    ASSERT_TRUE(room.Take(60));
    ASSERT_FALSE(watched.expired());
    EXPECT_EQ(watched.lock()->used_bytes(), 60u);
  }
  EXPECT_TRUE(watched.expired());
}

TEST(RoomAhead, OfManyStreamsNeverExceedsTheBudgetAndIsReturned) {
  constexpr int kStreams = 8, kMessages = 2000;
  const auto budget = BudgetOf(100);
  std::vector<std::jthread> streams;
  for (int i = 0; i < kStreams; ++i) {
    streams.emplace_back([&budget, bytes = static_cast<std::size_t>(20 + i)] {
      RoomAhead room(budget);
      for (int message = 0; message < kMessages; ++message) {
        if (room.Take(bytes)) (void)room.Use(2 * bytes);
        EXPECT_LE(budget->used_bytes(), budget->limit_bytes());
        room.Release();
      }
    });
  }
  streams.clear();
  EXPECT_EQ(budget->used_bytes(), 0u);
}

}  // namespace
}  // namespace dhpmap
