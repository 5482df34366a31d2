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

/// A client's connection and our end of the pair of sockets to the door behind: passes bytes both ways, and looks at
/// the frames that pass. Holds what the one side does not take at most once a direction, up to the size of the scratch
/// that it is given; then it does not read the other. Thread-compatible.
class RelayedConnection {
 public:
  using Clock = std::chrono::steady_clock;

  /// `limits` is null where no HTTP/2 is spoken. Registers itself with the poller, which outlives it.
  RelayedConnection(ClientSocket client, Descriptor inner, std::unique_ptr<FrameLimits> limits, Poller& poller);
  ~RelayedConnection();
  RelayedConnection(const RelayedConnection&) = delete;
  RelayedConnection& operator=(const RelayedConnection&) = delete;

  /// False if the system has no room for it.
  bool Begin();
  /// Moves what can be moved now, at most a share, so that others have their turn.
  void OnReady(int descriptor, std::uint32_t events, std::span<char> scratch);
  /// Goes on with what no descriptor tells of; see has_more.
  void Continue(std::span<char> scratch) { Move(true, true, scratch); }
  void AtTime(Clock::time_point now);

  /// There is more to move at once.
  [[nodiscard]] bool has_more() const { return has_more_ && !is_over_; }
  /// It is to be destroyed.
  [[nodiscard]] bool is_over() const { return is_over_; }
  /// Why, if it was ended.
  [[nodiscard]] Refusal refusal() const { return refusal_; }
  [[nodiscard]] int client() const { return client_.descriptor(); }
  [[nodiscard]] int inner() const { return inner_.get(); }

 private:
  /// One direction: what was read and not taken yet, and whether its source has ended.
  struct Flow {
    std::string waiting;
    std::size_t num_taken = 0;  // of it
    bool has_ended = false;
    bool is_end_told = false;

    [[nodiscard]] bool is_stuck() const { return !waiting.empty(); }
    [[nodiscard]] std::string_view rest() const { return std::string_view(waiting).substr(num_taken); }
    void Take(std::size_t num_bytes);
    void Keep(std::string_view bytes) { waiting.assign(bytes); }
  };

  void Move(bool up, bool down, std::span<char> scratch);
  /// Client to door, door to client: whether all that could be read now was.
  bool MoveUp(std::span<char> scratch);
  bool MoveDown(std::span<char> scratch);
  /// What waits; false if something still does.
  bool FlushUp();
  bool FlushDown();
  std::size_t SendUp(std::string_view bytes);
  std::size_t SendDown(std::string_view bytes);
  /// As much as there is now and fits, TLS records one after the other. Nothing if the flow ended, or all is over.
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
  bool is_inner_gone_ = false;  // and no more asked about
  bool has_more_ = false;
  bool is_over_ = false;
  Refusal refusal_ = Refusal::kNone;
  std::optional<Clock::time_point> last_words_until_;
};

}  // namespace dhpmap::net
