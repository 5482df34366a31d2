// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/number_reserve.h"

#include <gtest/gtest.h>

#include <future>
#include <vector>

#include "tests/support/wrapped_store.h"

namespace dhpmap {
namespace {

/// Stores marks; the test can make it slow or full.
class MarkStore final : public testing::WrappedStore {
 public:
  Status Reserve(const std::string& name, const NumberMarks& marks) override {
    EXPECT_EQ(name, "room");
    if (begun) begun->set_value();
    const std::lock_guard lock(disk);  // held by the test: it is slow
    if (is_full) return ResourceExhausted("full");
    reserved.push_back(marks);
    return Status::Ok();
  }

  std::mutex disk;
  bool is_full = false;
  std::optional<std::promise<void>> begun;
  std::vector<NumberMarks> reserved;
};

MapInfo InfoAt(std::int64_t revision, std::uint32_t next_submap_id) {
  MapInfo info;
  info.name = "room";
  info.revision = revision;
  info.next_submap_id = SubmapId(next_submap_id);
  return info;
}

constexpr NumberMarks kStored{1, SubmapId(1)};

TEST(NumberReserve, StoredNumbersNeedNoReservation) {
  MarkStore store;
  NumberReserve numbers(store, kStored);
  EXPECT_TRUE(numbers.Cover(InfoAt(1, 1)).ok());
  numbers.GoAhead("room");
  EXPECT_TRUE(store.reserved.empty());
}

TEST(NumberReserve, OnlyReservedNumbersAreCovered) {
  MarkStore store;
  NumberReserve numbers(store, kStored);
  for (std::int64_t revision = 2; revision < 5000; ++revision) {
    const auto next_id = static_cast<std::uint32_t>(1 + revision / 3);
    if (revision % 7 == 0) numbers.GoAhead("room");
    ASSERT_TRUE(numbers.Cover(InfoAt(revision, next_id)).ok());
    ASSERT_GE(store.reserved.back().revision, revision);
    ASSERT_GE(store.reserved.back().next_submap_id, SubmapId(next_id));
  }
  EXPECT_LT(store.reserved.size(), 50u) << "each costs a sync";
}

TEST(NumberReserve, AnEarlyReservationAvoidsWaiting) {
  MarkStore store;
  NumberReserve numbers(store, kStored);
  ASSERT_TRUE(numbers.Cover(InfoAt(2, 2)).ok());
  constexpr std::uint32_t kHalf = NumberReserve::kIdsAStep / 2;
  for (int turn = 0; turn < 20; ++turn) {
    const auto used = static_cast<std::uint32_t>(2 + kHalf * turn);
    ASSERT_TRUE(numbers.Cover(InfoAt(2 + turn, used)).ok());
    const std::size_t before = store.reserved.size();
    ASSERT_TRUE(numbers.Cover(InfoAt(3 + turn, used + kHalf - 1)).ok());
    ASSERT_EQ(store.reserved.size(), before) << "turn " << turn;
    ASSERT_TRUE(numbers.Cover(InfoAt(3 + turn, used + kHalf)).ok());
    numbers.GoAhead("room");
  }
}

TEST(NumberReserve, ReservedNumbersAreCoveredDuringALongReservation) {
  MarkStore store;
  NumberReserve numbers(store, kStored);
  ASSERT_TRUE(numbers.Cover(InfoAt(2, 2)).ok());
  constexpr std::uint32_t kUsed = NumberReserve::kIdsAStep * 6 / 10;
  ASSERT_TRUE(numbers.Cover(InfoAt(3, kUsed)).ok());  // more than half of the step
  store.begun.emplace();
  std::unique_lock slow(store.disk);
  auto ahead = std::async(std::launch::async, [&numbers] { numbers.GoAhead("room"); });
  store.begun->get_future().wait();
  EXPECT_TRUE(numbers.Cover(InfoAt(4, kUsed + 1)).ok());  // would never return if it waited
  slow.unlock();
  ahead.wait();
  store.begun.reset();
  EXPECT_EQ(store.reserved.back().next_submap_id, SubmapId(kUsed + NumberReserve::kIdsAStep));
}

TEST(NumberReserve, NumbersThatCannotBeReservedAreNotCovered) {
  MarkStore store;
  NumberReserve numbers(store, kStored);
  store.is_full = true;
  EXPECT_EQ(numbers.Cover(InfoAt(2, 1)).code(), StatusCode::kResourceExhausted);
  numbers.GoAhead("room");
  EXPECT_EQ(numbers.Cover(InfoAt(2, 1)).code(), StatusCode::kResourceExhausted);
  store.is_full = false;
  numbers.GoAhead("room");
  store.is_full = true;
  EXPECT_TRUE(numbers.Cover(InfoAt(2, 1)).ok());
}

TEST(NumberReserve, IsReleasedAtTheEnd) {
  MarkStore store;
  NumberReserve numbers(store, kStored);
  numbers.Release(InfoAt(1, 1));
  EXPECT_TRUE(store.reserved.empty()) << "nothing was reserved";
  ASSERT_TRUE(numbers.Cover(InfoAt(5, 7)).ok());
  numbers.Release(InfoAt(5, 7));
  EXPECT_EQ(store.reserved.back().revision, 5);
  EXPECT_EQ(store.reserved.back().next_submap_id, SubmapId(7));
  const std::size_t num_reserved = store.reserved.size();
  numbers.Release(InfoAt(5, 7));
  EXPECT_EQ(store.reserved.size(), num_reserved) << "nothing is left to give back";
  EXPECT_TRUE(numbers.Cover(InfoAt(6, 7)).ok());
  EXPECT_GT(store.reserved.size(), num_reserved) << "what was given back is covered no longer";
}

}  // namespace
}  // namespace dhpmap
