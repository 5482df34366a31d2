// SPDX-License-Identifier: BSD-3-Clause
#include "server/http/session.h"

#include <gtest/gtest.h>

#include "tests/unit/server/http/fake_connection.h"

namespace dhpmap::http {
namespace {

HeadResult Head(std::string method, std::string target, bool has_body = false) {
  HeadResult head;
  head.head.method = std::move(method);
  head.head.target = std::move(target);
  head.head.headers = {{"Host", "localhost"}};
  head.has_body = has_body;
  return head;
}

HeadResult Post(std::uint64_t length) {
  HeadResult head = Head("POST", "/x", true);
  head.head.content_length = length;
  return head;
}

class SessionTest : public ::testing::Test {
 protected:
  SessionTest() {
    session = std::make_shared<Session>(connection, handler, names, [this](Session*) { ++num_closed; });
    session->Start();
  }
  ~SessionTest() override { connection->Close(); }  // releases the session, which holds it
  /// The status of the last answer.
  int LastStatus() const {
    const std::string& head = connection->writes.back();
    return head.starts_with("HTTP/1.1 ") ? std::stoi(head.substr(9, 3)) : 0;
  }
  bool LastSays(const std::string& text) const { return connection->writes.back().find(text) != std::string::npos; }
  FakeExchange& exchange() { return *handler.exchange; }
  Responder& responder() { return *handler.responder; }

  FakeHandler handler;
  HostNames names{"127.0.0.1", {}};
  std::shared_ptr<FakeConnection> connection = std::make_shared<FakeConnection>();
  std::shared_ptr<Session> session;
  int num_closed = 0;
};

TEST_F(SessionTest, RequestsAreHandledOneByOne) {
  for (int i = 1; i <= 3; ++i) {
    EXPECT_EQ(connection->num_head_reads, i);
    connection->Hear(Head("GET", "/now"));
    EXPECT_EQ(LastStatus(), 200);
    EXPECT_EQ(connection->num_head_reads, i) << "not before the answer is written";
    connection->Written();
  }
  EXPECT_FALSE(connection->is_closed);
}

TEST_F(SessionTest, ABodyIsReadAtTheExchangesPace) {
  connection->Hear(Post(6));
  EXPECT_EQ(connection->num_body_reads, 1);
  exchange().wants_more = false;
  connection->HearBody("abc", false);
  EXPECT_EQ(connection->num_body_reads, 1) << "it does not want more yet";
  responder().ResumeBody();
  responder().ResumeBody();
  EXPECT_EQ(connection->num_body_reads, 2) << "one read at a time";
  connection->HearBody("def", true);
  EXPECT_EQ(exchange().body, "abcdef");
  EXPECT_TRUE(exchange().has_body_end);
  EXPECT_TRUE(connection->is_watching);
  responder().Reply({});
  connection->Written();
  EXPECT_FALSE(connection->is_watching);
  EXPECT_EQ(connection->num_head_reads, 2);
}

TEST_F(SessionTest, OnlyTheFirstReplyCounts) {
  connection->Hear(Head("GET", "/x"));
  responder().Reply({});
  responder().Reply({});
  EXPECT_EQ(connection->writes.size(), 1u);
}

TEST_F(SessionTest, ContinueIsWrittenBeforeTheBodyIsRead) {
  HeadResult head = Post(3);
  head.head.headers.emplace_back("Expect", "100-Continue");
  connection->Hear(head);
  EXPECT_EQ(LastStatus(), 100);
  EXPECT_EQ(connection->num_body_reads, 0);
  connection->Written();
  EXPECT_EQ(connection->num_body_reads, 1);
}

TEST_F(SessionTest, ARefusedBodyIsNotInvited) {
  HeadResult head = Post(3);
  head.head.target = "/now";
  head.head.headers.emplace_back("Expect", "100-continue");
  connection->Hear(head);
  EXPECT_EQ(LastStatus(), 200);
  EXPECT_TRUE(LastSays("Connection: close")) << "the client may send it or not";
}

TEST_F(SessionTest, ASmallUnwantedBodyIsDrainedAndTheConnectionStays) {
  HeadResult head = Post(10);
  head.head.target = "/now";
  connection->Hear(head);
  EXPECT_EQ(connection->num_body_reads, 0) << "only after the answer";
  connection->Written();
  EXPECT_EQ(connection->num_body_reads, 1);
  connection->HearBody("0123", false);
  connection->HearBody("456789", true);
  EXPECT_EQ(connection->num_head_reads, 2);
  EXPECT_FALSE(connection->has_closed_sending);
}

TEST_F(SessionTest, ALargeUnwantedBodyEndsTheConnection) {
  HeadResult head = Post(10u << 20);
  head.head.target = "/now";
  connection->Hear(head);
  EXPECT_TRUE(LastSays("Connection: close"));
  connection->Written();
  EXPECT_TRUE(connection->has_closed_sending);
  EXPECT_FALSE(connection->is_closed) << "or the client would not see the answer";
  connection->HearBody("x", true);
  EXPECT_TRUE(connection->is_closed);
  EXPECT_EQ(num_closed, 1);
}

TEST_F(SessionTest, AnAnswerDuringABodyDropsTheRest) {
  connection->Hear(Post(1000));
  connection->HearBody("abc", false);
  ASSERT_EQ(connection->num_body_reads, 2);
  responder().Reply({});
  connection->Written();
  EXPECT_EQ(connection->num_body_reads, 2) << "that read is still under way";
  connection->HearBody("def", false);
  EXPECT_EQ(exchange().body, "abc");
  EXPECT_EQ(connection->num_body_reads, 3);
  connection->HearBody("ghi", true);
  EXPECT_EQ(connection->num_head_reads, 2);
}

TEST_F(SessionTest, AStreamIsChunkedAndEndsWithAnEmptyChunk) {
  connection->Hear(Head("GET", "/x"));
  responder().BeginStream({}, std::nullopt);
  EXPECT_TRUE(connection->writes.empty()) << "the head goes with the first chunk";
  responder().Chunk("hello");
  EXPECT_TRUE(LastSays("Transfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n"));
  connection->Written();
  EXPECT_EQ(exchange().num_written, 1);
  responder().EndStream(true);
  EXPECT_EQ(connection->writes.back(), "0\r\n\r\n");
  connection->Written();
  EXPECT_EQ(connection->num_head_reads, 2);
}

TEST_F(SessionTest, AStreamOfKnownLengthHasNoChunks) {
  connection->Hear(Head("GET", "/x"));
  responder().BeginStream({}, 5);
  responder().Chunk("hello");
  EXPECT_TRUE(LastSays("Content-Length: 5\r\n\r\nhello"));
  connection->Written();
  responder().EndStream(true);
  EXPECT_EQ(connection->writes.size(), 1u);
  EXPECT_EQ(connection->num_head_reads, 2);
}

TEST_F(SessionTest, ATruncatedStreamClosesTheConnection) {
  connection->Hear(Head("GET", "/x"));
  responder().BeginStream({}, std::nullopt);
  responder().Chunk("hello");
  connection->Written();
  responder().EndStream(false);
  EXPECT_TRUE(connection->is_closed);
}

TEST_F(SessionTest, AnHttp10StreamLastsUntilTheConnectionEnds) {
  HeadResult head = Head("GET", "/x");
  head.is_http_1_1 = head.keep_alive = false;
  connection->Hear(head);
  responder().BeginStream({}, std::nullopt);
  responder().Chunk("hello");
  EXPECT_TRUE(LastSays("Connection: close\r\n\r\nhello"));
  connection->Written();
  responder().EndStream(true);
  EXPECT_TRUE(connection->is_closed);
}

TEST_F(SessionTest, HeadHasNoBody) {
  connection->Hear(Head("HEAD", "/now"));
  EXPECT_TRUE(LastSays("Content-Length: 3\r\n"));
  EXPECT_TRUE(connection->writes.back().ends_with("\r\n\r\n"));
}

TEST_F(SessionTest, AnInvalidRequestIsAnsweredAndEndsTheConnection) {
  HeadResult head;
  head.outcome = ReadOutcome::kMalformed;
  head.problem = "no colon";
  connection->Hear(head);
  EXPECT_EQ(LastStatus(), 400);
  EXPECT_TRUE(LastSays("Connection: close"));
  EXPECT_TRUE(LastSays("MALFORMED_HTTP"));
  connection->Written();
  EXPECT_TRUE(connection->is_closed);
}

TEST_F(SessionTest, ATooLargeHeadIsAnswered) {
  HeadResult head;
  head.outcome = ReadOutcome::kTooLarge;
  connection->Hear(head);
  EXPECT_EQ(LastStatus(), 431);
}

TEST_F(SessionTest, ABrokenBodyIsAnsweredUnlessAnAnswerHasBegun) {
  connection->Hear(Post(6));
  connection->HearBody("", false, ReadOutcome::kMalformed);
  EXPECT_TRUE(exchange().is_closed);
  EXPECT_EQ(LastStatus(), 400);
  connection->Written();
  EXPECT_TRUE(connection->is_closed);
}

TEST_F(SessionTest, ABrokenBodyDuringAnAnswerClosesTheConnection) {
  connection->Hear(Post(6));
  responder().BeginStream({}, std::nullopt);
  responder().Chunk("x");
  connection->HearBody("", false, ReadOutcome::kMalformed);
  EXPECT_TRUE(exchange().is_closed);
  EXPECT_TRUE(connection->is_closed);
}

TEST_F(SessionTest, ADisconnectedClientEndsTheExchange) {
  connection->Hear(Head("GET", "/x"));
  const auto left = handler.exchange;
  connection->Events()->OnPeerClosed();
  EXPECT_TRUE(left->is_closed);
  EXPECT_EQ(num_closed, 1);
  responder().Reply({});
  responder().Chunk("x");
  responder().EndStream(true);
  EXPECT_TRUE(connection->writes.empty()) << "nothing is said to nobody";
}

TEST_F(SessionTest, AClientThatOnlyStopsSendingGetsItsAnswer) {
  connection->Hear(Head("GET", "/x"));
  EXPECT_EQ(connection->probe, "HTTP/1.1 100 Continue\r\n\r\n");
  connection->Events()->OnPeerEnded();
  EXPECT_FALSE(exchange().is_closed);
  responder().Reply({});
  EXPECT_TRUE(LastSays("Connection: close"));
  connection->Written();
  EXPECT_TRUE(connection->is_closed);
}

TEST_F(SessionTest, AnOldClientIsNotProbed) {
  HeadResult head = Head("GET", "/x");
  head.is_http_1_1 = false;
  connection->Hear(head);
  EXPECT_EQ(connection->probe, "");
}

TEST_F(SessionTest, AnUnknownTransferCodingIsNotImplementedAndEndsTheConnection) {
  HeadResult head;
  head.outcome = ReadOutcome::kUnknownCoding;
  connection->Hear(head);
  EXPECT_TRUE(LastSays("UNKNOWN_TRANSFER_CODING"));
  EXPECT_EQ(handler.num_requests, 0);
  connection->Written();
  EXPECT_TRUE(connection->is_closed);
}

TEST_F(SessionTest, ARequestForAnotherHostNeverReachesTheHandler) {
  HeadResult head = Head("GET", "/now");
  head.head.headers = {{"Host", "evil.example"}};
  connection->Hear(head);
  EXPECT_EQ(LastStatus(), 421);
  EXPECT_EQ(handler.num_requests, 0);
  connection->Written();
  EXPECT_TRUE(connection->is_closed);
}

TEST_F(SessionTest, TheBodyOfARefusedRequestIsNeverParsedAsARequest) {
  HeadResult head = Post(10);
  head.head.headers = {{"Host", "evil.example"}};
  connection->Hear(head);
  connection->Written();
  EXPECT_EQ(connection->num_body_reads, 1);
  connection->HearBody("0123456789", true);
  EXPECT_TRUE(connection->is_closed);
}

TEST_F(SessionTest, KnowsHowLongItHasBeenIdle) {
  EXPECT_TRUE(session->idle_since());
  connection->Hear(Head("GET", "/x"));
  EXPECT_FALSE(session->idle_since());
  session->CloseIfIdle();
  EXPECT_FALSE(connection->is_closed) << "a request is under way";
  responder().Reply({});
  connection->Written();
  EXPECT_TRUE(session->idle_since());
  session->CloseIfIdle();
  EXPECT_TRUE(connection->is_closed);
}

TEST(SurplusSession, RefusesSurplusConnections) {
  FakeHandler handler;
  const HostNames names{"127.0.0.1", {}};
  const auto connection = std::make_shared<FakeConnection>();
  const auto session = std::make_shared<Session>(connection, handler, names, nullptr);
  session->Start(/*is_surplus=*/true);
  connection->Hear(Head("GET", "/now"));
  EXPECT_NE(connection->writes.back().find("TOO_MANY_CONNECTIONS"), std::string::npos);
  EXPECT_EQ(handler.num_requests, 0);
  connection->Written();
  EXPECT_TRUE(connection->is_closed);
}

TEST_F(SessionTest, AFailedWriteEndsTheExchange) {
  connection->Hear(Head("GET", "/x"));
  responder().BeginStream({}, std::nullopt);
  responder().Chunk("x");
  connection->Written(false);
  EXPECT_TRUE(exchange().is_closed);
  EXPECT_TRUE(connection->is_closed);
}

TEST_F(SessionTest, DrainingClosesAnIdleConnectionAtOnce) {
  session->Drain();
  EXPECT_TRUE(connection->is_closed);
}

TEST_F(SessionTest, DrainingWaitsForTheRunningRequest) {
  connection->Hear(Head("GET", "/x"));
  session->Drain();
  EXPECT_FALSE(connection->is_closed);
  responder().Reply({});
  EXPECT_TRUE(LastSays("Connection: close"));
  connection->Written();
  EXPECT_TRUE(connection->is_closed);
}

TEST(SessionStates, NothingFollowsTheEnd) {
  for (const Life next : {Life::kOpen, Life::kDraining, Life::kClosed}) EXPECT_FALSE(IsLegal(Life::kClosed, next));
  EXPECT_FALSE(IsLegal(Answer::kEnding, Answer::kStreaming)) << "no chunk after the last";
  EXPECT_FALSE(IsLegal(Intake::kDropping, Intake::kReading)) << "what is dropped is not wanted again";
  EXPECT_FALSE(IsLegal(Intake::kReading, Intake::kHead)) << "no request inside of another's body";
}

}  // namespace
}  // namespace dhpmap::http
