// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "server/net/descriptor.h"
#include "server/net/tls_context.h"

namespace dhpmap::net {

/// A client's connection, plain or with TLS. Never blocks. Thread-compatible.
class ClientSocket {
 public:
  enum class Outcome {
    kDone,
    kLater,   ///< call again when the socket is ready, see wants_to_write
    kEnd,     ///< the client half-closed
    kFailed,  ///< the connection or its TLS is broken
  };
  struct Moved {
    Outcome outcome = Outcome::kLater;
    std::size_t num_bytes = 0;  ///< for kDone; at least one
  };

  /// `session` null: no TLS.
  ClientSocket(Descriptor socket, SslSession session);

  /// Continues the TLS handshake; call until kDone. Without TLS kDone at once.
  Outcome Handshake();
  Moved Read(char* to, std::size_t most);
  /// Bytes that were not written must be passed again next time, optionally with more after them.
  Moved Write(const char* from, std::size_t num_bytes);
  /// Half-closes: the client sees the end of the data, and may still send.
  void CloseSending();

  [[nodiscard]] int descriptor() const { return socket_.get(); }
  [[nodiscard]] ssl_st* session() const { return session_.get(); }
  /// Whether the last kLater waits for the socket to become writable.
  [[nodiscard]] bool wants_to_write() const { return wants_to_write_; }
  /// Whether Read may return data although the socket has none.
  [[nodiscard]] bool has_read_ahead() const;

 private:
  Outcome OutcomeOf(int result);

  Descriptor socket_;
  SslSession session_;
  bool wants_to_write_ = false;
};

}  // namespace dhpmap::net
