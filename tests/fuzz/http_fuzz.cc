// SPDX-License-Identifier: BSD-3-Clause
// A connection's bytes through the parser and the session: the same requests and the same answers however they arrive.
#include <algorithm>
#include <string_view>
#include <tuple>
#include <utility>

#include "server/http/host_names.h"
#include "server/http/request_parser.h"
#include "server/http/session.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/unit/server/http/fake_connection.h"

namespace dhpmap {
namespace {

using namespace http;

struct Outcome {
  std::vector<std::tuple<std::string, std::string, std::string>> requests;  ///< method, target, body up to the answer
  std::string answers;
  bool operator==(const Outcome&) const = default;
};

/// What a target does: "/early" answers in the middle of the body, "/held" takes a part of it at a time, "/stream"
/// answers in parts, "/now" before the body, any other at its end.
class Replier final : public Exchange {
 public:
  Replier(const RequestHead& head, std::shared_ptr<Responder> responder, Outcome* outcome)
      : target_(head.target), responder_(std::move(responder)), outcome_(*outcome), index_(outcome->requests.size()) {
    outcome_.requests.emplace_back(head.method, head.target, "");
  }

  bool OnBody(std::string_view data) override {
    if (has_replied_) return true;
    std::string& body = std::get<2>(outcome_.requests[index_]);
    body += data;
    if (target_ == "/early" && body.size() >= 4) {
      body.resize(4);
      Reply("early");
    }
    is_held = target_ == "/held";
    return !is_held;
  }
  void OnBodyEnd() override {
    if (has_replied_) return;
    if (target_ != "/stream") return Reply(std::get<2>(outcome_.requests[index_]));
    has_replied_ = true;
    responder_->BeginStream({}, std::nullopt);
    responder_->Chunk("one");
  }
  void OnWritten() override {
    if (num_written_++ == 0) return responder_->Chunk("two");
    responder_->EndStream(true);
  }
  void OnClosed() override { has_replied_ = true; }

  bool is_held = false;

 private:
  void Reply(std::string body) {
    has_replied_ = true;
    responder_->Reply({200, {}, std::move(body)});
  }

  const std::string target_;
  const std::shared_ptr<Responder> responder_;
  Outcome& outcome_;
  const std::size_t index_;
  bool has_replied_ = false;
  int num_written_ = 0;
};

class Replies final : public Handler {
 public:
  explicit Replies(Outcome* outcome) : outcome_(outcome) {}
  std::shared_ptr<Exchange> Begin(const RequestHead& head, const std::shared_ptr<Responder>& answering) const override {
    responder = answering;
    exchange = std::make_shared<Replier>(head, answering, outcome_);
    if (head.target != "/now") return exchange;
    exchange.reset();
    answering->Reply({200, {}, "now"});
    return nullptr;
  }
  Response ErrorAnswer(const Status& error) const override { return {400, {}, std::string(error.reason().name())}; }

  mutable std::shared_ptr<Responder> responder;
  mutable std::shared_ptr<Replier> exchange;

 private:
  Outcome* outcome_;
};

/// Without the dates.
std::string Undated(std::string text) {
  for (std::size_t at = 0; (at = text.find("Date: ", at)) != std::string::npos;) {
    text.erase(at, std::string_view("Date: Sun, 06 Nov 1994 08:49:37 GMT\r\n").size());
  }
  return text;
}

/// Plays the network: what is written has always gone before more bytes come, so many at a time.
class Network {
 public:
  Network(std::string_view bytes, std::size_t piece_bytes) : bytes_(bytes), piece_bytes_(piece_bytes) {}

  Outcome Run() {
    const auto session = std::make_shared<Session>(connection_, handler_, names_, nullptr);
    session->Start();
    while (!connection_->is_closed && Step()) continue;
    session->Abort();
    handler_.responder.reset();
    handler_.exchange.reset();
    for (const std::string& text : connection_->writes) outcome_.answers += Undated(text);
    return outcome_;
  }

 private:
  /// False if nobody waits for anything.
  bool Step() {
    if (num_written_ < connection_->writes.size()) {
      ++num_written_;
      connection_->Written();
    } else if (handler_.exchange && std::exchange(handler_.exchange->is_held, false)) {
      handler_.responder->ResumeBody();
    } else if (connection_->num_head_reads > num_heads_) {
      Head();
    } else if (connection_->num_body_reads > num_bodies_) {
      Body();
    } else {
      return false;
    }
    return true;
  }

  void Head() {
    if (!std::exchange(is_in_head_, true)) parser_ = RequestParser();
    RequestParser::HeadStep step = parser_.AddHead(unread_);
    unread_.erase(0, step.num_used);
    if (!step.is_complete && More()) return;
    ++num_heads_;
    is_in_head_ = false;
    if (!step.is_complete) step.head.outcome = ReadOutcome::kClosed;
    connection_->Hear(std::move(step.head));
  }

  void Body() {
    std::string out(piece_bytes_, '\0');
    const RequestParser::BodyStep step = parser_.AddBody(unread_, out);
    unread_.erase(0, step.num_used);
    if (!step.is_complete() && More()) return;
    ++num_bodies_;
    const ReadOutcome outcome = step.is_complete() ? step.outcome : ReadOutcome::kClosed;
    connection_->HearBody(std::string_view(out).substr(0, step.num_written), step.is_end, outcome);
  }

  bool More() {
    unread_ += bytes_.substr(0, piece_bytes_);
    const bool had_more = !bytes_.empty();
    bytes_.remove_prefix(std::min(piece_bytes_, bytes_.size()));
    return had_more;
  }

  std::string_view bytes_;
  const std::size_t piece_bytes_;
  Outcome outcome_;
  Replies handler_{&outcome_};
  HostNames names_{"127.0.0.1", {}};
  std::shared_ptr<FakeConnection> connection_ = std::make_shared<FakeConnection>();
  RequestParser parser_;
  std::string unread_;
  bool is_in_head_ = false;
  std::size_t num_written_ = 0;
  int num_heads_ = 0, num_bodies_ = 0;
};

}  // namespace

std::vector<std::string> fuzz::Seeds() {
  const std::string host = " HTTP/1.1\r\nHost: localhost\r\n";
  const std::string chunked = "Transfer-Encoding: chunked\r\n\r\n5;a=b\r\nhello\r\n1\r\n!\r\n0\r\nT: t\r\n\r\n";
  return {"\1GET /now" + host + "\r\nGET /x" + host + "\r\n",
          "\3POST /late" + host + chunked + "GET /stream" + host + "\r\n",
          "\7POST /early" + host + "Content-Length: 6\r\n\r\nhello!GET /x" + host + "\r\n",
          "\2PUT /held" + host + chunked + "PUT /now" + host + chunked + "HEAD /stream" + host + "\r\n",
          "\4POST /x" + host + "Expect: 100-continue\r\n" + chunked,
          "\5POST /held HTTP/1.0\r\nContent-Length: 3\r\nConnection: keep-alive\r\n\r\nabcGET /stream HTTP/1.0\r\n\r\n",
          "\6GET /x HTTP/1.1\r\nHost: elsewhere\r\n\r\n",
          "\1GET /x" + host + "Transfer-Encoding: gzip\r\n\r\n",
          "\1POST /x" + host + "Transfer-Encoding: chunked\r\n\r\nzz\r\n"};
}

}  // namespace dhpmap

// The first byte is the size of the pieces.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dhpmap;
  if (size < 1) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const Outcome whole = Network(bytes, bytes.size() + 1).Run();
  fuzz::Require(Network(bytes, 1u + data[0]).Run() == whole);
  fuzz::Require(Network(bytes, 1).Run() == whole);
  return 0;
}
