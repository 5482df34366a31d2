// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "server/rest/dispatcher.h"
#include "server/rest/http_connection.h"

namespace dhpmap::rest {

/// The HTTP/1.1 rules of one connection: one request after the other, keep-alive, framing of answers, what to do with a
/// body nobody wants. All calls on the connection's sequence of execution, but Post.
class HttpSession final : public ConnectionEvents, public Responder, public std::enable_shared_from_this<HttpSession> {
 public:
  /// `on_closed` runs once, when the connection is closed. The dispatcher outlives the session.
  HttpSession(std::shared_ptr<Connection> connection, const Dispatcher& dispatcher,
              std::function<void(HttpSession*)> on_closed)
      : connection_(std::move(connection)), dispatcher_(dispatcher), on_closed_(std::move(on_closed)) {}

  void Start() { connection_->Start(shared_from_this()); }
  /// The request under way is the last; without one, closes.
  void Drain();
  void Abort();

  // ConnectionEvents
  void OnHead(HeadResult head) override;
  void OnBodyData(ReadOutcome outcome, std::string_view data, bool is_end) override;
  void OnWriteDone(bool ok) override;
  void OnPeerClosed() override { Abort(); }

  // Responder
  void Reply(HttpResponse response) override;
  void BeginStream(HttpResponse head, std::optional<std::uint64_t> length) override;
  void Chunk(std::string data) override;
  void EndStream(bool complete) override;
  void ResumeBody() override;
  void Post(std::function<void()> task) override { connection_->Post(std::move(task)); }

 private:
  void ReplyToBadHead(const HeadResult& head);
  void ReadBody();
  void BodyEnded();
  void Finish();
  void NextRequest();
  void DropBody();
  [[nodiscard]] std::string HeadText(const HttpResponse& response, const std::string& framing);

  const std::shared_ptr<Connection> connection_;
  const Dispatcher& dispatcher_;
  std::function<void(HttpSession*)> on_closed_;
  bool draining_ = false;
  bool closed_ = false;

  // Of the request under way.
  std::shared_ptr<Exchange> exchange_;
  bool idle_ = true;  // no request is under way
  bool is_head_ = false;
  bool is_http_1_1_ = true;
  bool keep_alive_ = true;
  bool small_body_ = false;  // cheaper to read to its end than to open a new connection
  bool body_done_ = true;
  bool reading_body_ = false;
  bool dropping_body_ = false;
  std::chrono::steady_clock::time_point drop_deadline_;
  bool sending_continue_ = false;
  bool finishing_ = false;  // the write under way is the last of this answer
  bool answered_ = false;   // an answer has been begun
  std::string stream_head_;
  bool chunked_ = false;
};

}  // namespace dhpmap::rest
