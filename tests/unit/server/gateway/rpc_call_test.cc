// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/rpc_call.h"

#include <gtest/gtest.h>

#include <deque>

#include "mapping/base/mutex.h"
#include "tests/unit/server/gateway/canned_server.h"

namespace dhpmap::gateway {
namespace {

using std::chrono::milliseconds;
constexpr std::chrono::minutes kLong{1};

CallOptions To(const std::string& method) { return {.rpc_path = "/test.Service/" + method}; }

struct UnaryEnd {
  int num_calls = 0;
  RpcStatus status;
  std::string response;
};

/// Records the events of a unary call.
class UnaryEar {
 public:
  std::function<void(RpcStatus, std::string)> Done() {
    return [this](RpcStatus status, std::string response) {
      const MutexLock lock(mutex_);
      end_ = {.num_calls = end_.num_calls + 1, .status = std::move(status), .response = std::move(response)};
      changed_.NotifyAll();
    };
  }
  UnaryEnd Wait() {
    const MutexLock lock(mutex_);
    changed_.WaitFor(mutex_, kLong, [this]() DHPMAP_REQUIRES(mutex_) { return end_.num_calls > 0; });
    return end_;
  }

 private:
  Mutex mutex_;
  CondVar changed_;
  UnaryEnd end_ DHPMAP_GUARDED_BY(mutex_);
};

/// Records the events as text.
class StreamEar final : public StreamListener {
 public:
  void OnMessage(std::string message) override { Hear("message " + message); }
  void OnReadEnd() override { Hear("read end"); }
  void OnSent(bool ok) override { Hear(ok ? "sent" : "not sent"); }
  void OnDone(RpcStatus status) override { Hear("done " + std::to_string(status.code)); }

  /// The next event; "" if there is none.
  std::string Next() {
    const MutexLock lock(mutex_);
    if (!changed_.WaitFor(mutex_, kLong, [this]() DHPMAP_REQUIRES(mutex_) { return !heard_.empty(); })) return "";
    std::string first = std::move(heard_.front());
    heard_.pop_front();
    return first;
  }

 private:
  void Hear(std::string what) {
    const MutexLock lock(mutex_);
    heard_.push_back(std::move(what));
    changed_.NotifyAll();
  }

  Mutex mutex_;
  CondVar changed_;
  std::deque<std::string> heard_ DHPMAP_GUARDED_BY(mutex_);
};

class RpcCallerTest : public ::testing::Test {
 protected:
  ~RpcCallerTest() override { EXPECT_TRUE(caller.WaitUntilIdle(kLong)) << "a caller outlives its calls"; }

  CannedServer server;
  RpcCaller caller{server.channel()};
};

TEST_F(RpcCallerTest, AUnaryCallEndsOnceWithItsAnswer) {
  server.Set("M", {.messages = {"answer"}});
  UnaryEar ear;
  CallOptions options = To("M");
  options.metadata = {{"x-request-id", "7"}};
  caller.StartUnary(options, "question", ear.Done());
  ASSERT_TRUE(ear.Wait().status.ok());
  ASSERT_TRUE(caller.WaitUntilIdle(kLong));
  EXPECT_EQ(ear.Wait().num_calls, 1);
  EXPECT_EQ(ear.Wait().response, "answer");
  const HeardCall heard = server.WaitForCall();
  EXPECT_EQ(heard.method, "/test.Service/M");
  EXPECT_EQ(heard.requests, std::vector<std::string>{"question"});
  EXPECT_EQ(heard.metadata.find("x-request-id")->second, "7");
}

TEST_F(RpcCallerTest, AFailureHasDetailsAndNoAnswer) {
  server.Set("M", {.messages = {}, .status = grpc::Status(grpc::NOT_FOUND, "gone", "details")});
  UnaryEar ear;
  caller.StartUnary(To("M"), "", ear.Done());
  const UnaryEnd end = ear.Wait();
  EXPECT_EQ(end.status.code, 5);
  EXPECT_EQ(end.status.message, "gone");
  EXPECT_EQ(end.status.details, "details");
  EXPECT_EQ(end.response, "");
}

TEST_F(RpcCallerTest, ACancelledCallEndsAndMayBeCancelledAgain) {
  server.Set("M", {.hang = true});
  UnaryEar ear;
  const auto call = caller.StartUnary(To("M"), "", ear.Done());
  server.WaitForCall();
  EXPECT_FALSE(caller.WaitUntilIdle(milliseconds(1))) << "it is still running";
  call->Cancel();
  EXPECT_EQ(ear.Wait().status.code, 1);
  call->Cancel();
  EXPECT_TRUE(server.WaitForCancel());
}

TEST_F(RpcCallerTest, ATimeoutEndsACall) {
  server.Set("M", {.hang = true});
  UnaryEar ear;
  CallOptions options = To("M");
  options.timeout = milliseconds(20);
  caller.StartUnary(options, "", ear.Done());
  EXPECT_EQ(ear.Wait().status.code, 4);
}

TEST_F(RpcCallerTest, AStreamAnswersEachReadAndEachSend) {
  server.Set("M", {.acknowledge = [](const std::string& request) { return "got " + request; }});
  const auto ear = std::make_shared<StreamEar>();
  const auto call = caller.StartStream(To("M"), ear);
  for (const std::string message : {"a", "", "c"}) {
    call->Send(message);
    EXPECT_EQ(ear->Next(), "sent");
    call->Read();
    EXPECT_EQ(ear->Next(), "message got " + message);
  }
  call->SendEnd();
  call->Read();
  EXPECT_EQ(ear->Next(), "read end");
  call->Finish();
  EXPECT_EQ(ear->Next(), "done 0");
}

TEST_F(RpcCallerTest, ACancelledStreamStillEndsInOrder) {
  server.Set("M", {.hang = true});
  const auto ear = std::make_shared<StreamEar>();
  const auto call = caller.StartStream(To("M"), ear);
  call->Send("a");
  EXPECT_EQ(ear->Next(), "sent");
  call->Cancel();
  call->Read();
  EXPECT_EQ(ear->Next(), "read end");
  call->Finish();
  EXPECT_EQ(ear->Next(), "done 1");
}

TEST_F(RpcCallerTest, IsIdleOnlyAfterAllCallsHaveEnded) {
  EXPECT_TRUE(caller.WaitUntilIdle(milliseconds(0)));
  server.Set("M", {.hang = true});
  const auto ear = std::make_shared<StreamEar>();
  auto stream = caller.StartStream(To("M"), ear);
  EXPECT_FALSE(caller.WaitUntilIdle(milliseconds(0)));
  stream->Cancel();
  stream->Read();
  EXPECT_EQ(ear->Next(), "read end");
  stream->Finish();
  EXPECT_EQ(ear->Next(), "done 1");
  EXPECT_FALSE(caller.WaitUntilIdle(milliseconds(0))) << "we still hold it";
  stream.reset();
  EXPECT_TRUE(caller.WaitUntilIdle(kLong));
}

}  // namespace
}  // namespace dhpmap::gateway
