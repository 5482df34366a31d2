// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "proto/types/http_status.h"
#include "server/http/connection.h"
#include "server/http/exchange.h"

namespace dhpmap::http {

/// A connection that records its calls; the test plays the network.
class FakeConnection final : public Connection {
 public:
  void Start(std::shared_ptr<ConnectionEvents> listener) override {
    events = std::move(listener);
    ReadHead();
  }
  void ReadHead() override { ++num_head_reads; }
  void ReadBody() override { ++num_body_reads; }
  void Write(std::string first, std::string second) override { writes.push_back(first + second); }
  void WatchPeer(std::string text) override {
    is_watching = true;
    probe = std::move(text);
  }
  void StopWatching() override { is_watching = false; }
  void CloseSending() override { has_closed_sending = true; }
  void Close() override {
    is_closed = true;
    events.reset();
  }
  std::string local_address() const override { return "127.0.0.1"; }
  void Post(std::function<void()> task) override { task(); }

  /// Delivers a head.
  void Hear(HeadResult head) { Events()->OnHead(std::move(head)); }
  void HearBody(std::string_view data, bool is_end, ReadOutcome outcome = ReadOutcome::kOk) {
    Events()->OnBodyData(outcome, data, is_end);
  }
  void Written(bool ok = true) { Events()->OnWriteDone(ok); }
  std::shared_ptr<ConnectionEvents> Events() const { return events; }

  std::shared_ptr<ConnectionEvents> events;
  std::vector<std::string> writes;
  int num_head_reads = 0;
  int num_body_reads = 0;
  bool is_watching = false;
  std::string probe;
  bool has_closed_sending = false;
  bool is_closed = false;
};

/// An exchange that records its input.
class FakeExchange final : public Exchange {
 public:
  bool OnBody(std::string_view data) override {
    body += data;
    return wants_more;
  }
  void OnBodyEnd() override {
    has_body_end = true;
    if (at_body_end) at_body_end();
  }
  void OnWritten() override { ++num_written; }
  void OnClosed() override { is_closed = true; }

  std::string body;
  bool wants_more = true;
  bool has_body_end = false;
  std::function<void()> at_body_end;
  int num_written = 0;
  bool is_closed = false;
};

/// Answers "/now" at once with 200 and anything else by a FakeExchange.
class FakeHandler final : public Handler {
 public:
  std::shared_ptr<Exchange> Begin(const RequestHead& head, const std::shared_ptr<Responder>& answering) const override {
    ++num_requests;
    responder = answering;
    if (head.target == "/now") {
      answering->Reply(Response{200, {}, "now"});
      return nullptr;
    }
    exchange = std::make_shared<FakeExchange>();
    return exchange;
  }
  Response ErrorAnswer(const Status& error) const override {
    Response response;
    response.status = HttpStatusOf(static_cast<int>(error.code()), error.reason());
    response.body = std::string(error.reason().name());
    return response;
  }

  mutable int num_requests = 0;
  mutable std::shared_ptr<Responder> responder;
  mutable std::shared_ptr<FakeExchange> exchange;
};

}  // namespace dhpmap::http
