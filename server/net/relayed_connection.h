// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "server/net/client_socket.h"
#include "server/net/frame_limits.h"
#include "server/net/poller.h"
#include "server/net/refusal.h"

namespace dhpmap::net {

/// Forwards bytes between a client's connection and our end of the socket pair to the server; checks the frames on the
/// way. Buffers at most one scratch buffer per direction; while a receiver is slow, it does not read the sender.
/// Thread-compatible.
class RelayedConnection {
 public:
  using Clock = std::chrono::steady_clock;

  /// `limits` is null unless the protocol is HTTP/2. Registers with the poller, which must outlive it.
  RelayedConnection(ClientSocket client, Descriptor inner, std::unique_ptr<FrameLimits> limits, Poller& poller);
  ~RelayedConnection();
  RelayedConnection(const RelayedConnection&) = delete;
  RelayedConnection& operator=(const RelayedConnection&) = delete;

  /// False if the system is out of resources.
  bool Begin();
  /// Moves the available bytes, at most a share, so that other connections get their turn.
  void OnReady(int descriptor, std::uint32_t events, std::span<char> scratch);
  /// Continues without an event; see has_more.
  void Continue(std::span<char> scratch) { Move(true, true, scratch); }
  void AtTime(Clock::time_point now);

  /// Whether more can be moved at once.
  [[nodiscard]] bool has_more() const { return has_more_ && !is_over_; }
  /// Whether it can be destroyed.
  [[nodiscard]] bool is_over() const { return is_over_; }
  /// The reason, if a limit ended it.
  [[nodiscard]] Refusal refusal() const { return refusal_; }
  [[nodiscard]] int client() const { return client_.descriptor(); }
  [[nodiscard]] int inner() const { return inner_.get(); }

 private:
  /// One direction: bytes that were read and not yet written, and whether the source has ended.
  struct Flow {
    std::string waiting;
    std::size_t num_taken = 0;  // of `waiting`
    bool has_ended = false;
    bool is_end_told = false;

    [[nodiscard]] bool is_stuck() const { return !waiting.empty(); }
    [[nodiscard]] std::string_view rest() const { return std::string_view(waiting).substr(num_taken); }
    void Take(std::size_t num_bytes);
    void Keep(std::string_view bytes) { waiting.assign(bytes); }
  };

  void Move(bool up, bool down, std::span<char> scratch);
  /// Client to server, server to client. Returns whether all available bytes were read.
  bool MoveUp(std::span<char> scratch);
  bool MoveDown(std::span<char> scratch);
  /// Writes the buffered bytes; false if some remain.
  bool FlushUp();
  bool FlushDown();
  std::size_t SendUp(std::string_view bytes);
  std::size_t SendDown(std::string_view bytes);
  /// Reads what is available and fits, TLS record by record. 0 if the flow or the connection ended.
  std::size_t ReadClient(std::span<char> scratch);
  void TellEnds();
  void InnerIsGone();
  void Refuse(Refusal refusal);
  void SayGoAway(Refusal refusal);
  void UpdateInterest();

  ClientSocket client_;
  Descriptor inner_;
  const std::unique_ptr<FrameLimits> limits_;
  Poller& poller_;
  Flow up_, down_;
  std::uint32_t client_interest_ = 0, inner_interest_ = 0;
  bool is_inner_gone_ = false;  // removed from the poller
  bool has_more_ = false;
  bool is_over_ = false;
  Refusal refusal_ = Refusal::kNone;
  std::optional<Clock::time_point> last_words_until_;
};

}  // namespace dhpmap::net
