// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/client_socket.h"

#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace dhpmap::net {
namespace {

using Outcome = ClientSocket::Outcome;

Outcome OutcomeOfErrno() {
  return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR ? Outcome::kLater : Outcome::kFailed;
}

}  // namespace

ClientSocket::ClientSocket(Descriptor socket, SslSession session)
    : socket_(std::move(socket)), session_(std::move(session)) {
  if (session_ != nullptr) SSL_set_fd(session_.get(), socket_.get());
}

Outcome ClientSocket::Handshake() {
  if (session_ == nullptr) return Outcome::kDone;
  ERR_clear_error();  // left by other code on this thread
  const int result = SSL_do_handshake(session_.get());
  return result == 1 ? Outcome::kDone : OutcomeOf(result);
}

ClientSocket::Moved ClientSocket::Read(char* to, std::size_t most) {
  if (session_ == nullptr) {
    const ssize_t got = ::recv(socket_.get(), to, most, 0);
    if (got > 0) return {Outcome::kDone, static_cast<std::size_t>(got)};
    return {got == 0 ? Outcome::kEnd : OutcomeOfErrno()};
  }
  ERR_clear_error();
  std::size_t got = 0;
  const int result = SSL_read_ex(session_.get(), to, most, &got);
  if (result != 1) return {OutcomeOf(result)};
  wants_to_write_ = false;
  return {Outcome::kDone, got};
}

ClientSocket::Moved ClientSocket::Write(const char* from, std::size_t num_bytes) {
  if (session_ == nullptr) {
    const ssize_t sent = ::send(socket_.get(), from, num_bytes, MSG_NOSIGNAL);
    return sent > 0 ? Moved{Outcome::kDone, static_cast<std::size_t>(sent)} : Moved{OutcomeOfErrno()};
  }
  ERR_clear_error();
  std::size_t sent = 0;
  const int result = SSL_write_ex(session_.get(), from, num_bytes, &sent);
  if (result != 1) return {OutcomeOf(result)};
  wants_to_write_ = false;
  return {Outcome::kDone, sent};
}

Outcome ClientSocket::OutcomeOf(int result) {
  wants_to_write_ = false;
  switch (SSL_get_error(session_.get(), result)) {
    case SSL_ERROR_WANT_READ: return Outcome::kLater;
    case SSL_ERROR_WANT_WRITE: wants_to_write_ = true; return Outcome::kLater;
    case SSL_ERROR_ZERO_RETURN: return Outcome::kEnd;
    default: return Outcome::kFailed;  // also an end without TLS close_notify: the data may be truncated
  }
}

void ClientSocket::CloseSending() {
  if (session_ != nullptr) {
    ERR_clear_error();
    (void)SSL_shutdown(session_.get());  // best effort
  }
  ::shutdown(socket_.get(), SHUT_WR);
}

bool ClientSocket::has_read_ahead() const { return session_ != nullptr && SSL_has_pending(session_.get()) == 1; }

}  // namespace dhpmap::net
