// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "server/base/state_machine.h"
#include "server/http/connection.h"
#include "server/http/exchange.h"
#include "server/http/host_names.h"
#include "server/http/session_state.h"

namespace dhpmap::http {

/// The HTTP/1.1 protocol of one connection: one request after the other, keep-alive, framing of answers, unwanted
/// bodies. Call on the connection's sequence of execution, except Post.
class Session final : public ConnectionEvents, public Responder, public std::enable_shared_from_this<Session> {
 public:
  /// `on_closed` runs once, when the connection closes. The handler and the names must outlive the session.
  Session(std::shared_ptr<Connection> connection, const Handler& handler, const HostNames& names,
          std::function<void(Session*)> on_closed)
      : connection_(std::move(connection)), handler_(handler), names_(names), on_closed_(std::move(on_closed)) {}

  /// `is_surplus`: above the limit of connections; the first request gets 503.
  void Start(bool is_surplus = false);
  /// Closes after the current request; at once if there is none.
  void Drain();
  void Abort();
  /// Closes unless a request is running.
  void CloseIfIdle();
  /// Time since which no request has been running; nothing while one is. Thread-safe.
  [[nodiscard]] std::optional<std::chrono::steady_clock::time_point> idle_since() const;

  // ConnectionEvents
  void OnHead(HeadResult head) override;
  void OnBodyData(ReadOutcome outcome, std::string_view data, bool is_end) override;
  void OnWriteDone(bool ok) override;
  void OnPeerEnded() override;
  void OnPeerClosed() override { Abort(); }

  // Responder
  void Reply(Response response) override;
  void BeginStream(Response head, std::optional<std::uint64_t> length) override;
  void Chunk(std::string data) override;
  void EndStream(bool complete) override;
  void ResumeBody() override;
  void Post(std::function<void()> task) override { connection_->Post(std::move(task)); }

 private:
  void RefuseHead(const HeadResult& head);
  void BeginRequest(const RequestHead& head, bool waits_for_continue);
  void ReadBody();
  void Drop(bool is_end);
  void BodyFailed(ReadOutcome outcome);
  void BodyEnded();
  void Finish();
  void NextRequest();
  void DropBody();
  [[nodiscard]] std::string HeadText(const Response& response, const std::string& framing);

  const std::shared_ptr<Connection> connection_;
  const Handler& handler_;
  const HostNames& names_;
  std::function<void(Session*)> on_closed_;
  StateMachine<Life> life_{Life::kOpen};
  bool is_surplus_ = false;
  std::string peer_key_;                                             // empty for a unix: address
  std::atomic<std::chrono::steady_clock::time_point> idle_since_{};  // the clock's epoch while a request is running

  // State of the current request.
  StateMachine<Intake> intake_{Intake::kHead};
  StateMachine<Answer> answer_{Answer::kNone};
  std::shared_ptr<Exchange> exchange_;
  bool is_head_ = false;
  bool is_http_1_1_ = true;
  bool keep_alive_ = true;
  bool small_body_ = false;  // cheaper to read completely than to open a new connection
  std::chrono::steady_clock::time_point drop_deadline_;
  std::string stream_head_;  // sent with the first chunk
  bool chunked_ = false;
};

}  // namespace dhpmap::http
