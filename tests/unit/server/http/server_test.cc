// SPDX-License-Identifier: BSD-3-Clause
#include "server/http/server.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "proto/types/http_status.h"
#include "tests/support/eventually.h"
#include "tests/unit/server/http/http_client.h"

namespace dhpmap::http {
namespace {

using namespace std::string_literals;

/// Echoes the body; at "/late" only after the client has half-closed, at "/never" never.
class EchoHandler final : public Handler {
 public:
  class Echo final : public Exchange {
   public:
    Echo(const EchoHandler& handler, std::string target, std::shared_ptr<Responder> responder)
        : handler_(handler), target_(std::move(target)), responder_(std::move(responder)) {}
    bool OnBody(std::string_view data) override {
      body_ += data;
      return true;
    }
    void OnBodyEnd() override {
      if (target_ != "/never" && target_ != "/late") Answer();
    }
    void OnPeerEnded() override {
      if (target_ == "/late") Answer();
    }
    void OnWritten() override {}
    void OnClosed() override { ++handler_.num_closed; }

   private:
    void Answer() { responder_->Reply(Response{200, {}, target_ + " " + body_}); }

    const EchoHandler& handler_;
    std::string target_, body_;
    std::shared_ptr<Responder> responder_;
  };

  std::shared_ptr<Exchange> Begin(const RequestHead& head, const std::shared_ptr<Responder>& responder) const override {
    ++num_requests;
    return std::make_shared<Echo>(*this, head.target, responder);
  }
  Response ErrorAnswer(const Status& error) const override {
    Response response;
    response.status = HttpStatusOf(static_cast<int>(error.code()), error.reason());
    response.body = std::string(error.reason().name());
    return response;
  }

  mutable std::atomic<int> num_requests{0};
  mutable std::atomic<int> num_closed{0};
};

class ServerTest : public ::testing::Test {
 protected:
  void Start(ServerOptions options = {}) {
    options.address = "127.0.0.1:0";
    auto started = Server::Start(options, handler);
    ASSERT_TRUE(started.ok()) << started.status().message();
    server = std::move(*started);
  }
  void TearDown() override {
    if (server) {
      EXPECT_TRUE(server->Shutdown(std::chrono::seconds(0)));
    }
  }
  HttpAnswer AnswerTo(std::string_view request) {
    HttpClient client(server->port());
    client.SendRaw(request);
    return client.ReadAnswer();
  }

  EchoHandler handler;
  std::unique_ptr<Server> server;
};

TEST_F(ServerTest, AnUnknownTransferCodingIsRefusedAndItsBodyNeverARequest) {
  Start();
  for (const char* coding : {"gzip", "xchunked", "gzip, chunked", "chunked, identity", "identity",
                             "chunked\r\nTransfer-Encoding: chunked"}) {
    const int before = handler.num_requests;
    HttpClient client(server->port());
    client.SendRaw(std::string("POST /a HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: ") + coding +
                   "\r\n\r\nDELETE /smuggled HTTP/1.1\r\nHost: localhost\r\n\r\n");
    const int status = client.ReadAnswer().status;
    EXPECT_TRUE(status == 501 || status == 400) << coding << ": " << status;
    EXPECT_TRUE(client.IsClosedByServer()) << coding;
    EXPECT_EQ(handler.num_requests, before) << coding;
  }
  EXPECT_EQ(AnswerTo("POST /a HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: gzip\r\n\r\n").status, 501);
}

TEST_F(ServerTest, OnlyOurNamesAreServed) {
  Start({.allowed_hosts = {"maps.example.com"}});
  EXPECT_EQ(AnswerTo("GET /a HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server->port()) + "\r\n\r\n").status, 200);
  EXPECT_EQ(AnswerTo("GET /a HTTP/1.1\r\nHost: localhost:1\r\n\r\n").status, 200);
  EXPECT_EQ(AnswerTo("GET /a HTTP/1.1\r\nHost: maps.example.com\r\n\r\n").status, 200);
  EXPECT_EQ(AnswerTo("GET /a HTTP/1.0\r\n\r\n").status, 200);
  EXPECT_EQ(AnswerTo("GET /a HTTP/1.1\r\nHost: evil.example\r\n\r\n").status, 421);
  EXPECT_EQ(AnswerTo("DELETE /a HTTP/1.1\r\nHost: evil.example\r\nOrigin: http://evil.example\r\n\r\n").status, 421);
  EXPECT_EQ(AnswerTo("GET /a HTTP/1.1\r\n\r\n").status, 400);
  EXPECT_EQ(AnswerTo("GET /a HTTP/1.1\r\nHost: localhost\r\nHost: localhost\r\n\r\n").status, 400);
  EXPECT_EQ(AnswerTo("GET http://evil.example/a HTTP/1.1\r\nHost: localhost\r\n\r\n").status, 421);
}

TEST_F(ServerTest, BodiesWhoseEndIsUncertainAreRefused) {
  Start();
  const std::string host = "Host: localhost\r\n";
  const std::string cases[] = {
      "POST /a HTTP/1.1\r\n" + host + "Content-Length: 3\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
      "POST /a HTTP/1.1\r\n" + host + "Content-Length: 3\r\nContent-Length: 4\r\n\r\nabc",
      "POST /a HTTP/1.1\r\n" + host + "Content-Length: 99999999999999999999999\r\n\r\nabc",
      "POST /a HTTP/1.1\r\n" + host + "Content-Length: -1\r\n\r\nabc",
      "POST /a HTTP/1.1\r\n" + host + "Transfer-Encoding: chunked\r\n\r\nfffffffffffffffff\r\nabc",
      "POST /a HTTP/1.1\r\n" + host + "Transfer-Encoding: chunked\r\n\r\n3\r\nabcdef\r\n0\r\n\r\n",
      "GET /a HTTP/1.1\n" + host + "\n\n",
      "GET /a HTTP/1.1\r\n" + host + "X: a\0b\r\n\r\n"s,
      "GET /a HTTP/1.1\r\n" + host + " folded: x\r\n\r\n",
      "GET /a\0b HTTP/1.1\r\n"s + host + "\r\n",
  };
  for (const std::string& request : cases) {
    HttpClient client(server->port());
    client.SendRaw(request);
    client.CloseSending();
    EXPECT_EQ(client.ReadAnswer().status, 400) << request;
    EXPECT_TRUE(client.IsClosedByServer()) << request;
  }
}

TEST_F(ServerTest, AClientThatHasClosedItsSideGetsItsAnswer) {
  Start();
  HttpClient client(server->port());
  client.SendRaw("POST /late HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\n\r\nhi");
  client.CloseSending();
  HttpAnswer answer = client.ReadAnswer();
  while (answer.status == 100) answer = client.ReadAnswer();
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.body, "/late hi");
  EXPECT_TRUE(client.IsClosedByServer());
}

TEST_F(ServerTest, AHalfClosedClientIsProbed) {
  Start();
  HttpClient client(server->port());
  client.SendRaw("GET /never HTTP/1.1\r\nHost: localhost\r\n\r\n");
  client.CloseSending();
  EXPECT_EQ(client.ReadAnswer().status, 100);
  EXPECT_EQ(handler.num_closed, 0);
}

TEST_F(ServerTest, ADisconnectedClientEndsItsExchange) {
  Start();
  {
    HttpClient client(server->port());
    client.SendRaw("GET /never HTTP/1.1\r\nHost: localhost\r\n\r\n");
    ASSERT_TRUE(testing::Eventually([&] { return handler.num_requests == 1; }));
  }
  EXPECT_TRUE(testing::Eventually([&] { return handler.num_closed == 1; }));
}

TEST_F(ServerTest, AnIncompleteHeadTimesOut) {
  Start({.idle_timeout = std::chrono::seconds(60), .head_timeout = std::chrono::milliseconds(200)});
  HttpClient slow(server->port());
  slow.SendRaw("GET /a HTTP/1.1\r\nHo");
  EXPECT_TRUE(slow.IsClosedByServer());
  EXPECT_TRUE(testing::Eventually(  // on a busy machine a whole head may come too late, too
      [&] { return AnswerTo("GET /a HTTP/1.1\r\nHost: localhost\r\n\r\n").status == 200; }));
}

TEST_F(ServerTest, AnIdleConnectionIsClosed) {
  Start({.idle_timeout = std::chrono::milliseconds(200), .head_timeout = std::chrono::seconds(60)});
  std::optional<HttpClient> idle;
  ASSERT_TRUE(testing::Eventually([&] {  // on a busy machine it may be idle for too long before it asks
    idle.emplace(server->port());
    return idle->Ask("GET", "/a").status == 200;
  }));
  EXPECT_TRUE(idle->IsClosedByServer());
}

/// Number of the port's established connections with TCP keepalive.
int NumKeptAlive(int local_port) {
  int count = 0;
  std::ifstream table("/proc/net/tcp");
  for (std::string line; std::getline(table, line);) {
    unsigned local = 0, state = 0, timer = 0;
    if (std::sscanf(line.c_str(), " %*d: %*x:%x %*x:%*x %x %*x:%*x %x:", &local, &state, &timer) != 3) continue;
    constexpr unsigned kEstablished = 1, kKeepalive = 2;
    count += local == static_cast<unsigned>(local_port) && state == kEstablished && timer == kKeepalive;
  }
  return count;
}

TEST_F(ServerTest, ASilentPeerIsProbed) {
  Start();
  HttpClient waits(server->port());
  waits.SendRaw("GET /never HTTP/1.1\r\nHost: localhost\r\n\r\n");
  ASSERT_TRUE(testing::Eventually([&] { return handler.num_requests == 1; }));
  EXPECT_TRUE(testing::Eventually([&] { return NumKeptAlive(server->port()) == 1; }));
}

TEST_F(ServerTest, BeyondTheLimitTheIdlestConnectionIsClosed) {
  Start({.max_connections = 3});
  std::vector<std::unique_ptr<HttpClient>> clients;
  for (int i = 0; i < 3; ++i) {
    clients.push_back(std::make_unique<HttpClient>(server->port()));
    ASSERT_EQ(clients.back()->Ask("GET", "/a").status, 200);
  }
  HttpClient fourth(server->port());
  EXPECT_EQ(fourth.Ask("GET", "/a").status, 200);
  EXPECT_TRUE(clients[0]->IsClosedByServer());
  EXPECT_EQ(clients[2]->Ask("GET", "/a").status, 200);
}

TEST_F(ServerTest, BeyondTheLimitOfBusyConnectionsTheAnswerIs503) {
  Start({.max_connections = 2});
  HttpClient first(server->port()), second(server->port());
  first.SendRaw("GET /never HTTP/1.1\r\nHost: localhost\r\n\r\n");
  second.SendRaw("GET /never HTTP/1.1\r\nHost: localhost\r\n\r\n");
  ASSERT_TRUE(testing::Eventually([&] { return handler.num_requests == 2; }));
  HttpClient third(server->port());
  EXPECT_EQ(third.Ask("GET", "/a").status, 503);
  EXPECT_TRUE(third.IsClosedByServer());
}

/// Lowers the limit of file descriptors during its lifetime.
class DescriptorLimit {
 public:
  explicit DescriptorLimit(rlim_t limit) {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    rlimit lower = before_;
    lower.rlim_cur = limit;
    ::setrlimit(RLIMIT_NOFILE, &lower);
  }
  ~DescriptorLimit() { ::setrlimit(RLIMIT_NOFILE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(ServerTest, ContinuesAnsweringWithoutFileDescriptors) {
  Start();
  std::vector<std::unique_ptr<HttpClient>> idle;
  const DescriptorLimit limit(64);
  for (int i = 0; i < 200; ++i) {
    auto client = std::make_unique<HttpClient>(server->port());
    if (client->Ask("GET", "/a").status != 200) break;  // this process has both ends: no descriptor for ours
    idle.push_back(std::move(client));
  }
  ASSERT_GT(idle.size(), 5u);
  // No descriptor is left now; a client needs one, and the server another.
  for (int i = 0; i < 5; ++i) {
    idle.pop_back();
    HttpClient client(server->port());
    EXPECT_EQ(client.Ask("GET", "/a").status, 200) << i;
  }
}

}  // namespace
}  // namespace dhpmap::http
