// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/request_flow.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/assert_ok.h"

namespace dhpmap {
namespace {

using Step = RequestFlow::Step;

grpc::ByteBuffer MessageOf(std::size_t num_bytes) {
  const grpc::Slice slice(std::string(num_bytes, 'm'));
  return {&slice, 1};
}

/// A stream that has read its first message, of 10 bytes.
class RequestFlowTest : public ::testing::Test {
 protected:
  void SetUp() override {
    flow.CountIn(budget);
    flow.OnReadBegun();
    ASSERT_OK(flow.OnRead(MessageOf(10)));
  }
  ByteBudget budget{100};
  RequestFlow flow{/*is_stream=*/true};
};

TEST_F(RequestFlowTest, ReadsTheNextMessageAfterTheLastOneWasSent) {
  EXPECT_EQ(flow.Next(), Step::kSend);
  EXPECT_EQ(flow.message().Length(), 10u);
  EXPECT_EQ(flow.Next(), Step::kNone) << "while it is sent";
  flow.OnSent();
  EXPECT_EQ(flow.Next(), Step::kRead);
  EXPECT_EQ(flow.Next(), Step::kNone) << "while it is read";
  ASSERT_OK(flow.OnRead(MessageOf(20)));
  EXPECT_EQ(flow.Next(), Step::kSend);
  EXPECT_EQ(flow.message().Length(), 20u);
  EXPECT_EQ(budget.used_bytes(), 30u) << "the first one is kept until an answer comes";
}

TEST_F(RequestFlowTest, SendsTheClientsEndOnceAndAfterItsMessages) {
  EXPECT_EQ(flow.Next(), Step::kSend);
  flow.OnSent();
  EXPECT_EQ(flow.Next(), Step::kRead);
  flow.OnClientEnd();
  EXPECT_EQ(flow.Next(), Step::kSendEnd);
  EXPECT_EQ(flow.Next(), Step::kNone);
}

TEST_F(RequestFlowTest, GivesAnotherOwnerEverythingFromTheFirstMessageOn) {
  EXPECT_EQ(flow.Next(), Step::kSend);
  flow.OnSent();
  EXPECT_EQ(flow.Next(), Step::kRead);
  ASSERT_OK(flow.OnRead(MessageOf(20)));
  EXPECT_EQ(flow.Next(), Step::kSend);
  flow.OnNotTaken();
  EXPECT_EQ(flow.Next(), Step::kNone) << "nothing more goes to an upstream call that ends";
  ASSERT_TRUE(flow.CanRestart());
  flow.Restart();
  EXPECT_EQ(flow.Next(), Step::kSend);
  EXPECT_EQ(flow.message().Length(), 10u);
  flow.OnSent();
  EXPECT_EQ(flow.Next(), Step::kSend);
  EXPECT_EQ(flow.message().Length(), 20u);
  EXPECT_FALSE(flow.CanRestart()) << "the second one may be lost now";
}

TEST_F(RequestFlowTest, CannotRestartOnceTheOwnerHasAnswered) {
  EXPECT_EQ(flow.Next(), Step::kSend);
  flow.OnAnswer();
  EXPECT_FALSE(flow.CanRestart());
}

TEST_F(RequestFlowTest, SendsTheFirstMessageToAnOwnerThatAnswersBeforeIt) {
  flow.OnAnswer();
  EXPECT_EQ(flow.Next(), Step::kSend);
}

TEST_F(RequestFlowTest, RefusesAMessageBeyondTheBudgetAndReadsNoMore) {
  EXPECT_EQ(flow.Next(), Step::kSend);
  flow.OnSent();
  EXPECT_EQ(flow.Next(), Step::kRead);
  EXPECT_EQ(flow.OnRead(MessageOf(95)).reason(), Reason("TOO_MANY_BYTES"));
  EXPECT_EQ(budget.used_bytes(), 10u);
}

TEST(OneRequestFlowTest, SendsTheRequestAndTheEndTogether) {
  ByteBudget budget(100);
  RequestFlow flow(/*is_stream=*/false);
  flow.CountIn(budget);
  EXPECT_EQ(flow.SetRequest(MessageOf(101)).reason(), Reason("TOO_MANY_BYTES"));
  ASSERT_OK(flow.SetRequest(MessageOf(100)));
  EXPECT_EQ(flow.Next(), Step::kSendLast);
  flow.OnSent();
  EXPECT_EQ(flow.Next(), Step::kNone);
}

}  // namespace
}  // namespace dhpmap
