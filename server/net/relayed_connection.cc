// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/relayed_connection.h"

#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace dhpmap::net {
namespace {

using Outcome = ClientSocket::Outcome;

constexpr int kTurns = 4;  ///< full scratch buffers before other connections get their turn
/// Time for the client to receive the server's last bytes after the server has closed.
constexpr std::chrono::seconds kLastWords{10};

bool IsLater(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

}  // namespace

void RelayedConnection::Flow::Take(std::size_t num_bytes) {
  num_taken += num_bytes;
  if (num_taken < waiting.size()) return;
  std::string().swap(waiting);  // idle connections hold no buffer
  num_taken = 0;
}

RelayedConnection::RelayedConnection(ClientSocket client, Descriptor inner, std::unique_ptr<FrameLimits> limits,
                                     Poller& poller)
    : client_(std::move(client)), inner_(std::move(inner)), limits_(std::move(limits)), poller_(poller) {}

RelayedConnection::~RelayedConnection() {
  poller_.Remove(client_.descriptor());
  if (!is_inner_gone_) poller_.Remove(inner_.get());
}

bool RelayedConnection::Begin() {
  client_interest_ = inner_interest_ = EPOLLIN;
  has_more_ = true;  // TLS may have read beyond the preface
  return poller_.Add(client_.descriptor(), client_interest_) && poller_.Add(inner_.get(), inner_interest_);
}

void RelayedConnection::OnReady(int descriptor, std::uint32_t events, std::span<char> scratch) {
  if (is_over_) return;
  if (descriptor == inner_.get() && (events & (EPOLLHUP | EPOLLERR)) != 0) {
    InnerIsGone();
  }
  const bool is_client_gone = descriptor == client_.descriptor() && (events & (EPOLLHUP | EPOLLERR)) != 0;
  if (is_client_gone && (events & EPOLLIN) == 0) {
    is_over_ = true;
    return;
  }
  const bool is_client = descriptor == client_.descriptor();
  const bool may_read = (events & ~std::uint32_t{EPOLLOUT}) != 0, may_write = (events & EPOLLOUT) != 0;
  const bool up = is_client ? may_read || client_.wants_to_write() : may_write;
  Move(up, is_client ? may_write : may_read, scratch);
}

/// Stops polling the inner socket, which would report for ever. Its last bytes may still be read.
void RelayedConnection::InnerIsGone() {
  if (!std::exchange(is_inner_gone_, true)) poller_.Remove(inner_.get());
}

void RelayedConnection::Move(bool up, bool down, std::span<char> scratch) {
  const bool is_up_done = !up || MoveUp(scratch);
  const bool is_down_done = !down || is_over_ || MoveDown(scratch);
  has_more_ = !is_up_done || !is_down_done;
  if (!is_over_) TellEnds();
  if (!is_over_) UpdateInterest();
}

bool RelayedConnection::MoveUp(std::span<char> scratch) {
  for (int turn = 0; turn < kTurns; ++turn) {
    if (!FlushUp() || up_.has_ended) return true;
    const std::size_t got = ReadClient(scratch);
    if (got == 0) return true;
    const std::string_view bytes(scratch.data(), got);
    if (limits_ != nullptr) {
      if (const Refusal refusal = limits_->FromClient(bytes, Clock::now()); refusal != Refusal::kNone) {
        Refuse(refusal);
        return true;
      }
    }
    const std::size_t sent = SendUp(bytes);
    if (sent < got) up_.Keep(bytes.substr(sent));
    if (is_over_ || (got < scratch.size() && !client_.has_read_ahead())) return true;
  }
  return up_.is_stuck();
}

std::size_t RelayedConnection::ReadClient(std::span<char> scratch) {
  std::size_t num_read = 0;
  while (num_read < scratch.size()) {
    const ClientSocket::Moved read = client_.Read(scratch.data() + num_read, scratch.size() - num_read);
    if (read.outcome == Outcome::kDone) {
      num_read += read.num_bytes;
      if (client_.has_read_ahead()) continue;
    } else {
      up_.has_ended = read.outcome == Outcome::kEnd;
      is_over_ = read.outcome == Outcome::kFailed && num_read == 0;
    }
    break;
  }
  return num_read;
}

bool RelayedConnection::MoveDown(std::span<char> scratch) {
  for (int turn = 0; turn < kTurns; ++turn) {
    if (!FlushDown() || down_.has_ended) return true;
    const ssize_t got = ::recv(inner_.get(), scratch.data(), scratch.size(), 0);
    if (got < 0 && IsLater(errno)) return true;
    if (got <= 0) {
      down_.has_ended = true;
      if (got < 0) InnerIsGone();
      return true;
    }
    const std::string_view bytes(scratch.data(), static_cast<std::size_t>(got));
    Refusal refusal = Refusal::kNone;
    if (limits_ != nullptr) refusal = limits_->FromServer(bytes, Clock::now());
    const std::size_t sent = SendDown(bytes);
    if (sent < bytes.size()) down_.Keep(bytes.substr(sent));
    if (refusal != Refusal::kNone) Refuse(refusal);
    // The poller no longer reports a closed inner socket, so read on to its end here.
    if (is_over_ || (bytes.size() < scratch.size() && !is_inner_gone_)) return true;
  }
  return down_.is_stuck();
}

bool RelayedConnection::FlushUp() {
  while (up_.is_stuck()) {
    const std::size_t sent = SendUp(up_.rest());
    if (sent == 0) return false;
    up_.Take(sent);
  }
  return !is_over_;
}

bool RelayedConnection::FlushDown() {
  while (down_.is_stuck()) {
    const std::size_t sent = SendDown(down_.rest());
    if (sent == 0) return false;
    down_.Take(sent);
  }
  return !is_over_;
}

std::size_t RelayedConnection::SendUp(std::string_view bytes) {
  const ssize_t sent = ::send(inner_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (sent > 0) return static_cast<std::size_t>(sent);
  if (IsLater(errno)) return 0;
  // The server has closed and takes no more bytes. Its last ones may still be on the way to the client.
  up_.has_ended = up_.is_end_told = true;
  return bytes.size();
}

std::size_t RelayedConnection::SendDown(std::string_view bytes) {
  std::size_t num_sent = 0;
  while (num_sent < bytes.size()) {
    const ClientSocket::Moved sent = client_.Write(bytes.data() + num_sent, bytes.size() - num_sent);
    if (sent.outcome == Outcome::kDone) {
      num_sent += sent.num_bytes;
      continue;
    }
    is_over_ |= sent.outcome != Outcome::kLater;
    break;
  }
  return num_sent;
}

/// Half-closes each side once it has received everything that the other sent before its end.
void RelayedConnection::TellEnds() {
  if (up_.has_ended && !up_.is_stuck() && !std::exchange(up_.is_end_told, true)) ::shutdown(inner_.get(), SHUT_WR);
  if (down_.has_ended && !down_.is_stuck() && !std::exchange(down_.is_end_told, true)) client_.CloseSending();
  if (is_inner_gone_ && !last_words_until_) last_words_until_ = Clock::now() + kLastWords;
  is_over_ |= down_.is_end_told && (up_.is_end_told || is_inner_gone_);
}

void RelayedConnection::AtTime(Clock::time_point now) {
  if (is_over_) return;
  if (last_words_until_ && now > *last_words_until_) is_over_ = true;
  if (limits_ == nullptr) return;
  if (const Refusal refusal = limits_->AtTime(now); refusal != Refusal::kNone) Refuse(refusal);
}

void RelayedConnection::Refuse(Refusal refusal) {
  refusal_ = refusal;
  if (limits_ != nullptr && !down_.is_stuck() && limits_->is_between_server_frames()) SayGoAway(refusal);
  is_over_ = true;
}

/// GOAWAY (RFC 9113, 6.8), as far as it can be written at once.
void RelayedConnection::SayGoAway(Refusal refusal) {
  constexpr char kEnhanceYourCalm = 0xB;
  const std::string_view why = RefusalName(refusal);
  std::string frame = {0, 0, static_cast<char>(8 + why.size()), static_cast<char>(FrameType::kGoAway), 0, 0, 0, 0, 0};
  frame.append({0x7F, '\xFF', '\xFF', '\xFF', 0, 0, 0, kEnhanceYourCalm}).append(why);
  (void)client_.Write(frame.data(), frame.size());
  client_.CloseSending();
}

void RelayedConnection::UpdateInterest() {
  const auto in = [](const Flow& flow) { return flow.has_ended || flow.is_stuck() ? 0u : unsigned{EPOLLIN}; };
  const auto out = [](bool wants) { return wants ? unsigned{EPOLLOUT} : 0u; };
  const std::uint32_t client = in(up_) | out(down_.is_stuck() || client_.wants_to_write());
  if (client != std::exchange(client_interest_, client)) poller_.Change(client_.descriptor(), client);
  if (is_inner_gone_) return;
  const std::uint32_t inner = in(down_) | out(up_.is_stuck());
  if (inner != std::exchange(inner_interest_, inner)) poller_.Change(inner_.get(), inner);
}

}  // namespace dhpmap::net
