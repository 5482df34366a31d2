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

/// Limits what one HTTP/2 connection may do, from its first frame on, whether or not it acknowledges SETTINGS. Observes
/// both directions: frames of the server end streams, and explain why the client sends PING and WINDOW_UPDATE. Uses a
/// few hundred bytes per connection. Thread-compatible; the caller supplies the time.
class FrameLimits {
 public:
  using Time = TokenBucket::Time;

  static constexpr std::size_t kMostStreams = 128;
  /// A client may cancel all its calls at once, and all of the next batch, without losing its connection.
  static constexpr double kResets = 2.0 * kMostStreams, kResets_per_s = 33;
  static constexpr double kOwnResets = 32;  ///< of these; beyond them they also count for the peer
  static constexpr std::uint32_t kMostHeaderBlock_bytes = 16'384;
  static constexpr int kMostHeaderFrames = 8;
  static constexpr double kControl = 200, kControl_per_s = 50;
  static constexpr std::uint32_t kMostFrame_bytes = 16'384;  ///< the initial limit of HTTP/2; gRPC does not raise it
  static constexpr std::chrono::seconds kAcknowledgeWithin{10};

  /// `peer` may be null: then there are no limits across connections.
  explicit FrameLimits(std::shared_ptr<PeerCounts> peer)
      : peer_(std::move(peer)), from_client_(*this), from_server_(*this) {}
  FrameLimits(const FrameLimits&) = delete;
  FrameLimits& operator=(const FrameLimits&) = delete;

  /// Checks the client's bytes after the preface, in order. After a refusal the caller must end the connection.
  Refusal FromClient(std::string_view bytes, Time now);
  /// Checks the server's bytes.
  Refusal FromServer(std::string_view bytes, Time now);
  /// Checks timeouts.
  [[nodiscard]] Refusal AtTime(Time now) const;
  /// Whether a frame of our own may be inserted after the bytes that FromServer has seen.
  [[nodiscard]] bool is_between_server_frames() const { return server_reader_.is_between_frames(); }
  [[nodiscard]] std::size_t num_streams() const { return streams_.size(); }

 private:
  struct OpenStream {
    std::uint32_t id;
    bool is_answered;  // the server has begun its answer
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
  /// Control, unless a frame of the server explains it.
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
  int num_answers_ = 0;  // frames that the client may send because of its calls and the server's DATA

  std::vector<OpenStream> streams_;
  std::uint32_t last_stream_ = 0;

  // The client's current header block.
  HeaderCheck check_;
  std::uint32_t block_stream_ = 0;  // 0: none
  std::uint32_t block_bytes_ = 0;
  int num_block_frames_ = 0;
  bool is_last_of_block_ = false;
  std::uint32_t before_fragment_bytes_ = 0, fragment_bytes_ = 0;  // remaining bytes of the frame
  bool has_pad_length_ = false;                                   // still expected

  // State of the server's direction.
  int num_unacknowledged_ = 0;  // SETTINGS
  Time unacknowledged_since_{};
  FrameHead server_head_;
  bool is_reset_for_cause_ = false;
};

}  // namespace dhpmap::net
