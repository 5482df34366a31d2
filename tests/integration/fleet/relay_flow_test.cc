// SPDX-License-Identifier: BSD-3-Clause
// Flow control of answers through a relay: one message at a time, and a budget for what is in memory. If the relay read
// ahead, the budget would refuse the message. request_flow_test.cc tests the other direction.
#include <gtest/gtest.h>

#include <thread>

#include "tests/integration/fleet/relay_to_hand.h"

namespace dhpmap::testing {
namespace {

constexpr int kMany = 60;

TEST_F(RelayToHand, AClientThatReadsLateStopsTheOwnersStream) {
  Open(kLarge_bytes + (kLarge_bytes / 2));
  const auto call = Call(kAnswers);
  ASSERT_TRUE(call->WriteLast(Request()));
  HeldCall& held = owner.Accept();
  ASSERT_TRUE(held.Read());
  ASSERT_TRUE(held.Write(std::string(kLarge_bytes, 'a'))) << "the relay takes the first one at once";
  std::atomic<int> num_written = 1;
  std::thread writer([&] {
    while (num_written < kMany && held.Write(std::string(kLarge_bytes, 'a'))) ++num_written;
    held.End(grpc::Status::OK);
  });
  EXPECT_TRUE(Eventually([&] { return budget->used_bytes() >= kLarge_bytes; }));
  for (int i = 0; i < kMany; ++i) {
    EXPECT_LE(budget->used_bytes(), kLarge_bytes);
    EXPECT_EQ(call->Read(), kLarge_bytes) << i;
  }
  EXPECT_EQ(call->Read(), std::nullopt);
  EXPECT_OK(call->Finish());
  writer.join();
  EXPECT_TRUE(IsAllGivenBack());
}

TEST_F(RelayToHand, AnAnswerBeyondTheBudgetEndsTheStreamAtBothSides) {
  Open(kLarge_bytes / 2);
  const auto call = Call(kAnswers);
  ASSERT_TRUE(call->WriteLast(Request()));
  HeldCall& held = owner.Accept();
  (void)held.Write(std::string(kLarge_bytes, 'a'));
  EXPECT_EQ(call->Read(), std::nullopt);
  EXPECT_EQ(ReasonOf(call->Finish()), "TOO_MANY_BYTES");
  EXPECT_TRUE(held.IsCancelledSoon());
  EXPECT_TRUE(IsAllGivenBack());
}

}  // namespace
}  // namespace dhpmap::testing
