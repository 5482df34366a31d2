// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "server/net/frame_reader.h"
#include "server/net/header_check.h"
#include "server/net/peer_table.h"
#include "server/net/refusal.h"
#include "server/net/token_bucket.h"

namespace dhpmap::net {

/// What one HTTP/2 connection may do, from its first frame on and whatever it acknowledges. Looks at both directions:
/// what the server ends frees a stream, and what it sends explains why the client sends PING and WINDOW_UPDATE.
/// Bounded: some hundred bytes a connection. Thread-compatible; whoever calls says what time it is.
class FrameLimits {
 public:
  using Time = TokenBucket::Time;

  static constexpr std::size_t kMostStreams = 128;
  /// Who gives up all its calls at once, and all that it asks next, keeps its connection.
  static constexpr double kResets = 2.0 * kMostStreams, kResets_per_s = 33;
  static constexpr double kOwnResets = 32;  ///< of these; beyond them they are its peer's, too
  static constexpr std::uint32_t kMostHeaderBlock_bytes = 16'384;
  static constexpr int kMostHeaderFrames = 8;
  static constexpr double kControl = 200, kControl_per_s = 50;
  static constexpr std::uint32_t kMostFrame_bytes = 16'384;  ///< what HTTP/2 begins with; gRPC does not raise it
  static constexpr std::chrono::seconds kAcknowledgeWithin{10};

  /// `peer` may be null: then this connection is all of its peer.
  explicit FrameLimits(std::shared_ptr<PeerCounts> peer)
      : peer_(std::move(peer)), from_client_(*this), from_server_(*this) {}
  FrameLimits(const FrameLimits&) = delete;
  FrameLimits& operator=(const FrameLimits&) = delete;

  /// Of what the client has sent after the preface, in order. After a refusal the connection is to be ended.
  Refusal FromClient(std::string_view bytes, Time now);
  /// Of what the server sends to it.
  Refusal FromServer(std::string_view bytes, Time now);
  /// What is due by time alone.
  [[nodiscard]] Refusal AtTime(Time now) const;
  /// Whether a frame of our own may follow what FromServer has seen.
  [[nodiscard]] bool is_between_server_frames() const { return server_reader_.is_between_frames(); }
  [[nodiscard]] std::size_t num_streams() const { return streams_.size(); }

 private:
  struct OpenStream {
    std::uint32_t id;
    bool is_answered;  // the server has begun to
  };
  struct ClientSink final : FrameSink {
    explicit ClientSink(FrameLimits& owner) : limits(owner) {}
    Refusal OnHead(const FrameHead& head) override { return limits.OnClientHead(head); }
    Refusal OnPayload(std::string_view part, bool is_end) override { return limits.OnClientPayload(part, is_end); }
    FrameLimits& limits;
  };
  struct ServerSink final : FrameSink {
    explicit ServerSink(FrameLimits& owner) : limits(owner) {}
    Refusal OnHead(const FrameHead& head) override { return limits.OnServerHead(head); }
    Refusal OnPayload(std::string_view part, bool is_end) override { return limits.OnServerPayload(part, is_end); }
    FrameLimits& limits;
  };

  Refusal OnClientHead(const FrameHead& head);
  Refusal OnClientPayload(std::string_view part, bool is_end);
  Refusal OnServerHead(const FrameHead& head);
  Refusal OnServerPayload(std::string_view part, bool is_end);
  Refusal BeginHeaders(const FrameHead& head);
  Refusal ContinueHeaders(const FrameHead& head);
  Refusal OnSettings(const FrameHead& head);
  Refusal Reset();
  Refusal Control();
  /// Control, unless what the server has sent explains it.
  Refusal Answer();
  std::vector<OpenStream>::iterator FindStream(std::uint32_t stream);
  bool CloseStream(std::uint32_t stream);
  Refusal OnReset(std::uint32_t stream);

  const std::shared_ptr<PeerCounts> peer_;
  ClientSink from_client_;
  ServerSink from_server_;
  FrameReader client_reader_, server_reader_;
  Time now_{};
  TokenBucket resets_{kResets, kResets_per_s}, control_{kControl, kControl_per_s};
  int num_answers_ = 0;  // frames of the client that its calls and the server's DATA explain

  std::vector<OpenStream> streams_;
  std::uint32_t last_stream_ = 0;

  // The header block that the client is sending.
  HeaderCheck check_;
  std::uint32_t block_stream_ = 0;  // 0: none
  std::uint32_t block_bytes_ = 0;
  int num_block_frames_ = 0;
  bool is_last_of_block_ = false;
  std::uint32_t before_fragment_bytes_ = 0, fragment_bytes_ = 0;  // of the frame, still to come
  bool has_pad_length_ = false;                                   // still to come

  // The server's.
  int num_unacknowledged_ = 0;  // SETTINGS
  Time unacknowledged_since_{};
  FrameHead server_head_;
  bool is_reset_for_cause_ = false;
};

}  // namespace dhpmap::net
