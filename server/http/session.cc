// SPDX-License-Identifier: BSD-3-Clause
#include "server/http/session.h"

#include <array>
#include <charconv>
#include <ctime>

namespace dhpmap::http {
namespace {

/// Also used to probe a client that does not expect it: clients must skip it.
constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
constexpr std::uint64_t kSmallBody_bytes = 64u << 10;
/// How long to read an unwanted body, so that the client sees the answer before the connection closes.
constexpr std::chrono::seconds kDropTimeout{10};

/// Date header (RFC 9110, 5.6.7), cached for a second.
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

void Session::Start(bool is_surplus) {
  is_surplus_ = is_surplus;
  idle_since_ = std::chrono::steady_clock::now();
  if (const net::PeerIdentity peer = connection_->peer(); !peer.uid && !peer.address.empty()) peer_key_ = PeerKey(peer);
  connection_->Start(shared_from_this());
}

std::optional<std::chrono::steady_clock::time_point> Session::idle_since() const {
  const auto since = idle_since_.load();
  if (since == std::chrono::steady_clock::time_point()) return std::nullopt;
  return since;
}

void Session::OnHead(HeadResult result) {
  idle_since_ = std::chrono::steady_clock::time_point();
  if (result.outcome == ReadOutcome::kClosed || result.outcome == ReadOutcome::kTimedOut) return Abort();
  is_head_ = result.head.method == "HEAD";
  is_http_1_1_ = result.is_http_1_1;
  keep_alive_ = result.keep_alive && life_.Is(Life::kOpen);
  const bool waits_for_continue = EqualsIgnoringCase(FindHeader(result.head.headers, "expect"), "100-continue");
  small_body_ = result.head.content_length.value_or(kSmallBody_bytes + 1) <= kSmallBody_bytes && !waits_for_continue;
  if (result.outcome != ReadOutcome::kOk) return RefuseHead(result);

  intake_.To(result.has_body ? Intake::kPaused : Intake::kDone);
  const std::string local_address = connection_->local_address();
  Status refused = names_.Check(result.head, is_http_1_1_, local_address);
  if (refused.ok() && is_surplus_) {
    refused = Unavailable("there are too many connections: try again later").WithReason("TOO_MANY_CONNECTIONS");
  }
  if (!refused.ok()) {
    keep_alive_ = false;
    return Reply(handler_.ErrorAnswer(refused));
  }
  result.head.peer_key = peer_key_;
  result.head.is_from_foreign_page = names_.IsFromForeignPage(result.head, local_address);
  BeginRequest(result.head, waits_for_continue);
}

void Session::BeginRequest(const RequestHead& head, bool waits_for_continue) {
  exchange_ = handler_.Begin(head, shared_from_this());
  if (!exchange_ || !answer_.Is(Answer::kNone)) return;
  if (intake_.Is(Intake::kDone)) return BodyEnded();
  if (!waits_for_continue || !is_http_1_1_) return ReadBody();
  intake_.To(Intake::kInviting);
  connection_->Write(std::string(kContinue), "");
}

/// Refuses a malformed head. What follows it cannot be parsed, so the connection closes.
void Session::RefuseHead(const HeadResult& head) {
  keep_alive_ = small_body_ = false;
  intake_.To(Intake::kDone);
  Status error = InvalidArgument("malformed HTTP: " + head.problem).WithReason("MALFORMED_HTTP");
  if (head.outcome == ReadOutcome::kTooLarge) {
    error = ResourceExhausted("the request's head is too large").WithReason("HEADER_TOO_LARGE");
  } else if (head.outcome == ReadOutcome::kUnknownCoding) {
    error = Status(StatusCode::kUnimplemented, "the only Transfer-Encoding taken is chunked")
                .WithReason("UNKNOWN_TRANSFER_CODING");
  }
  Reply(handler_.ErrorAnswer(error));
}

void Session::ReadBody() {
  if (!intake_.Is(Intake::kPaused) || life_.Is(Life::kClosed)) return;
  intake_.To(Intake::kReading);
  connection_->ReadBody();
}

void Session::OnBodyData(ReadOutcome outcome, std::string_view data, bool is_end) {
  if (outcome != ReadOutcome::kOk) return BodyFailed(outcome);
  if (intake_.Is(Intake::kDropping)) return Drop(is_end);
  intake_.To(Intake::kPaused);
  const auto exchange = exchange_;  // keep alive: it may give up and release itself
  const bool wants_more = exchange->OnBody(data);
  if (life_.Is(Life::kClosed)) return;
  if (is_end) {
    intake_.To(Intake::kDone);
    return BodyEnded();
  }
  if (wants_more) ReadBody();
}

void Session::BodyFailed(ReadOutcome outcome) {
  if (outcome != ReadOutcome::kMalformed || !answer_.Is(Answer::kNone)) return Abort();
  exchange_->OnClosed();
  exchange_.reset();
  keep_alive_ = false;
  intake_.To(Intake::kDone);
  Reply(handler_.ErrorAnswer(InvalidArgument("malformed HTTP body").WithReason("MALFORMED_HTTP")));
}

void Session::ResumeBody() { ReadBody(); }

void Session::BodyEnded() {
  const auto exchange = exchange_;  // keep alive: it may answer at once and release itself
  exchange->OnBodyEnd();
  if (exchange_ && answer_.IsAnyOf({Answer::kNone, Answer::kStreaming})) {
    connection_->WatchPeer(is_http_1_1_ ? std::string(kContinue) : std::string());
  }
}

void Session::OnWriteDone(bool ok) {
  if (!ok) return Abort();
  if (intake_.Is(Intake::kInviting)) {
    intake_.To(Intake::kPaused);
    return ReadBody();
  }
  if (answer_.Is(Answer::kEnding)) return Finish();
  if (const auto exchange = exchange_) exchange->OnWritten();
}

void Session::OnPeerEnded() {
  keep_alive_ = false;
  if (const auto exchange = exchange_) exchange->OnPeerEnded();
}

std::string Session::HeadText(const Response& response, const std::string& framing) {
  // An incomplete large body blocks the next request, so close the connection.
  if (!intake_.Is(Intake::kDone) && !small_body_) keep_alive_ = false;
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

void Session::Reply(Response response) {
  if (life_.Is(Life::kClosed) || !answer_.Is(Answer::kNone)) return;
  answer_.To(Answer::kEnding);
  const bool has_body = response.status != 204 && response.status != 304;
  std::string head =
      HeadText(response, has_body ? "Content-Length: " + std::to_string(response.body.size()) + "\r\n" : "");
  connection_->Write(std::move(head), is_head_ || !has_body ? std::string() : std::move(response.body));
}

void Session::BeginStream(Response head, std::optional<std::uint64_t> length) {
  answer_.To(Answer::kStreaming);
  chunked_ = !length && is_http_1_1_;
  if (!length && !is_http_1_1_) keep_alive_ = false;  // the connection's end marks the end of the answer
  stream_head_ = HeadText(head, length     ? "Content-Length: " + std::to_string(*length) + "\r\n"
                                : chunked_ ? "Transfer-Encoding: chunked\r\n"
                                           : "");
}

void Session::Chunk(std::string data) {
  if (life_.Is(Life::kClosed)) return;
  std::string first = std::move(stream_head_);
  stream_head_.clear();
  if (chunked_) {
    first += Hex(data.size()) + "\r\n";
    data += "\r\n";
  }
  connection_->Write(std::move(first), std::move(data));
}

void Session::EndStream(bool complete) {
  if (life_.Is(Life::kClosed)) return;
  if (!complete) return Abort();
  std::string last = std::move(stream_head_);
  stream_head_.clear();
  if (chunked_ && !is_head_) last += "0\r\n\r\n";
  answer_.To(Answer::kEnding);
  if (last.empty()) return Finish();
  connection_->Write(std::move(last), "");
}

/// The answer is written.
void Session::Finish() {
  answer_.To(Answer::kEnded);
  connection_->StopWatching();
  exchange_.reset();
  if (intake_.Is(Intake::kDone)) return NextRequest();
  DropBody();
}

void Session::DropBody() {
  drop_deadline_ = std::chrono::steady_clock::now() + kDropTimeout;
  if (!keep_alive_) connection_->CloseSending();
  const bool is_reading = intake_.Is(Intake::kReading);
  intake_.To(Intake::kDropping);
  if (!is_reading) connection_->ReadBody();
}

/// Handles a part of an unwanted body.
void Session::Drop(bool is_end) {
  if (is_end) {
    intake_.To(Intake::kDone);
    return NextRequest();
  }
  if (std::chrono::steady_clock::now() > drop_deadline_) return Abort();
  connection_->ReadBody();
}

void Session::NextRequest() {
  if (!keep_alive_) return Abort();
  intake_.To(Intake::kHead);
  answer_.To(Answer::kNone);
  idle_since_ = std::chrono::steady_clock::now();
  connection_->ReadHead();
}

void Session::Drain() {
  if (!life_.Is(Life::kOpen)) return;
  life_.To(Life::kDraining);
  keep_alive_ = false;
  if (intake_.Is(Intake::kHead)) Abort();
}

void Session::CloseIfIdle() {
  if (intake_.Is(Intake::kHead)) Abort();
}

void Session::Abort() {
  if (life_.Is(Life::kClosed)) return;
  life_.To(Life::kClosed);
  const auto self = shared_from_this();  // keep alive: the connection releases this
  if (exchange_) exchange_->OnClosed();
  exchange_.reset();
  connection_->Close();
  if (on_closed_) on_closed_(this);
}

}  // namespace dhpmap::http
