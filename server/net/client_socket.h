// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "server/net/descriptor.h"
#include "server/net/tls_context.h"

namespace dhpmap::net {

/// A client's connection, in the clear or inside of TLS. Never blocks. Thread-compatible.
class ClientSocket {
 public:
  enum class Outcome {
    kDone,
    kLater,   ///< when the socket is ready, see wants_to_write
    kEnd,     ///< the client sends no more
    kFailed,  ///< it is gone, or TLS is broken
  };
  struct Moved {
    Outcome outcome = Outcome::kLater;
    std::size_t num_bytes = 0;  ///< of kDone, at least one
  };

  /// Without a session, in the clear.
  ClientSocket(Descriptor socket, SslSession session);

  /// TLS's, to be called until it is kDone; in the clear it is at once.
  Outcome Handshake();
  Moved Read(char* to, std::size_t most);
  /// What was not taken comes again next time, with as much or more behind it.
  Moved Write(const char* from, std::size_t num_bytes);
  /// The client sees the end of what is sent, and may still be sending.
  void CloseSending();

  [[nodiscard]] int descriptor() const { return socket_.get(); }
  [[nodiscard]] ssl_st* session() const { return session_.get(); }
  /// Whether the last kLater waits for room to write.
  [[nodiscard]] bool wants_to_write() const { return wants_to_write_; }
  /// Whether there may be something to read though the socket has nothing.
  [[nodiscard]] bool has_read_ahead() const;

 private:
  Outcome OutcomeOf(int result);

  Descriptor socket_;
  SslSession session_;
  bool wants_to_write_ = false;
};

}  // namespace dhpmap::net
