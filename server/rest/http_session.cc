// SPDX-License-Identifier: BSD-3-Clause
#include "server/rest/http_session.h"

#include <array>
#include <charconv>
#include <ctime>

#include "server/rest/error_body.h"

namespace dhpmap::rest {
namespace {

constexpr std::uint64_t kSmallBody_bytes = 64u << 10;
/// How long an unwanted body is read, so that the client gets to see the answer before the connection goes.
constexpr std::chrono::seconds kDropTimeout{10};

/// RFC 9110 5.6.7, made anew once a second.
const std::string& DateText() {
  thread_local std::time_t made = 0;
  thread_local std::string text;
  if (const std::time_t now = std::time(nullptr); now != made) {
    made = now;
    std::tm utc{};
    gmtime_r(&now, &utc);
    std::array<char, 64> out;
    text.assign(out.data(), std::strftime(out.data(), out.size(), "%a, %d %b %Y %H:%M:%S GMT", &utc));
  }
  return text;
}

std::string Hex(std::size_t number) {
  std::array<char, 16> out;
  return {out.data(), std::to_chars(out.data(), out.data() + out.size(), number, 16).ptr};
}

}  // namespace

void HttpSession::OnHead(HeadResult result) {
  idle_ = false;
  finishing_ = answered_ = dropping_body_ = false;
  if (result.outcome == ReadOutcome::kClosed || result.outcome == ReadOutcome::kTimedOut) return Abort();
  is_head_ = result.head.method == "HEAD";
  is_http_1_1_ = result.is_http_1_1;
  keep_alive_ = result.keep_alive && !draining_;
  body_done_ = !result.has_body;
  const bool waits_for_continue = EqualsIgnoringCase(FindHeader(result.head.headers, "expect"), "100-continue");
  small_body_ = result.head.content_length.value_or(kSmallBody_bytes + 1) <= kSmallBody_bytes && !waits_for_continue;
  if (result.outcome != ReadOutcome::kOk) return ReplyToBadHead(result);

  exchange_ = dispatcher_.Begin(result.head, shared_from_this());
  if (!exchange_ || answered_) return;
  if (body_done_) return BodyEnded();
  if (!waits_for_continue || !is_http_1_1_) return ReadBody();
  sending_continue_ = true;
  connection_->Write("HTTP/1.1 100 Continue\r\n\r\n", "");
}

void HttpSession::ReplyToBadHead(const HeadResult& head) {
  keep_alive_ = small_body_ = false;
  body_done_ = true;  // whatever follows cannot be understood
  if (head.outcome == ReadOutcome::kTooLarge) {
    return Reply(ErrorResponse(ResourceExhausted("the request's head is too large").WithReason("HEAD_TOO_LARGE"),
                               AnswerFormat::kAny, 431));
  }
  Reply(ErrorResponse(InvalidArgument("malformed HTTP: " + head.problem).WithReason("MALFORMED_HTTP"),
                      AnswerFormat::kAny));
}

void HttpSession::ReadBody() {
  if (reading_body_ || body_done_ || closed_) return;
  reading_body_ = true;
  connection_->ReadBody();
}

void HttpSession::OnBodyData(ReadOutcome outcome, std::string_view data, bool is_end) {
  reading_body_ = false;
  if (outcome != ReadOutcome::kOk) {
    if (outcome != ReadOutcome::kMalformed || answered_) return Abort();
    exchange_->OnClosed();
    exchange_.reset();
    keep_alive_ = false;
    body_done_ = true;
    return Reply(
        ErrorResponse(InvalidArgument("malformed HTTP body").WithReason("MALFORMED_HTTP"), AnswerFormat::kAny));
  }
  bool wants_more = true;
  if (exchange_) wants_more = exchange_->OnBody(data);
  if (closed_) return;
  if (is_end) {
    body_done_ = true;
    if (dropping_body_) return NextRequest();
    return BodyEnded();
  }
  if (dropping_body_ && std::chrono::steady_clock::now() > drop_deadline_) return Abort();
  if (wants_more || dropping_body_) ReadBody();
}

void HttpSession::ResumeBody() { ReadBody(); }

void HttpSession::BodyEnded() {
  if (!exchange_) return;
  const auto exchange = exchange_;  // it may answer at once, and be let go
  exchange->OnBodyEnd();
  if (exchange_ && !finishing_ && !closed_) connection_->WatchPeer();
}

void HttpSession::OnWriteDone(bool ok) {
  if (!ok) return Abort();
  if (sending_continue_) {
    sending_continue_ = false;
    return ReadBody();
  }
  if (finishing_) return Finish();
  if (const auto exchange = exchange_) exchange->OnWritten();
}

std::string HttpSession::HeadText(const HttpResponse& response, const std::string& framing) {
  // A body that is still to come in full would be in the way of the next request.
  if (!body_done_ && !small_body_) keep_alive_ = false;
  std::string text = "HTTP/1.1 " + std::to_string(response.status);
  text += ' ';
  text += ReasonPhrase(response.status);
  text += "\r\nDate: " + DateText() + "\r\n";
  for (const auto& [name, value] : response.headers) text += name + ": " + value + "\r\n";
  text += framing;
  if (!keep_alive_) {
    text += "Connection: close\r\n";
  } else if (!is_http_1_1_) {
    text += "Connection: keep-alive\r\n";
  }
  return text + "\r\n";
}

void HttpSession::Reply(HttpResponse response) {
  if (closed_ || answered_) return;
  answered_ = finishing_ = true;
  const bool has_body = response.status != 204;
  std::string head =
      HeadText(response, has_body ? "Content-Length: " + std::to_string(response.body.size()) + "\r\n" : "");
  connection_->Write(std::move(head), is_head_ || !has_body ? std::string() : std::move(response.body));
}

void HttpSession::BeginStream(HttpResponse head, std::optional<std::uint64_t> length) {
  answered_ = true;
  chunked_ = !length && is_http_1_1_;
  if (!length && !is_http_1_1_) keep_alive_ = false;  // the end of the connection is the end of the answer
  stream_head_ = HeadText(head, length     ? "Content-Length: " + std::to_string(*length) + "\r\n"
                                : chunked_ ? "Transfer-Encoding: chunked\r\n"
                                           : "");
}

void HttpSession::Chunk(std::string data) {
  if (closed_) return;
  std::string first = std::move(stream_head_);
  stream_head_.clear();
  if (chunked_) {
    first += Hex(data.size()) + "\r\n";
    data += "\r\n";
  }
  connection_->Write(std::move(first), std::move(data));
}

void HttpSession::EndStream(bool complete) {
  if (closed_) return;
  if (!complete) return Abort();
  std::string last = std::move(stream_head_);
  stream_head_.clear();
  if (chunked_ && !is_head_) last += "0\r\n\r\n";
  finishing_ = true;
  if (last.empty()) return Finish();
  connection_->Write(std::move(last), "");
}

/// The answer is written.
void HttpSession::Finish() {
  connection_->StopWatching();
  exchange_.reset();
  if (body_done_) return NextRequest();
  DropBody();
}

void HttpSession::DropBody() {
  dropping_body_ = true;
  drop_deadline_ = std::chrono::steady_clock::now() + kDropTimeout;
  if (!keep_alive_) connection_->CloseSending();
  ReadBody();
}

void HttpSession::NextRequest() {
  if (!keep_alive_) return Abort();
  idle_ = true;
  if (draining_) return Abort();
  connection_->ReadHead();
}

void HttpSession::Drain() {
  draining_ = true;
  keep_alive_ = false;
  if (idle_) Abort();
}

void HttpSession::Abort() {
  if (closed_) return;
  closed_ = true;
  const auto self = shared_from_this();  // the connection lets go of us
  if (exchange_) exchange_->OnClosed();
  exchange_.reset();
  connection_->Close();
  if (on_closed_) on_closed_(this);
}

}  // namespace dhpmap::rest
