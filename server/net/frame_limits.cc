// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/frame_limits.h"

#include <algorithm>

namespace dhpmap::net {
namespace {

using namespace frame_flags;

/// The windows of the stream and of the connection, and a PING with which some clients measure bandwidth.
constexpr int kAnswersToData = 3;
/// A gRPC client opens windows for a call before its answer begins, and resets a call that the server has ended first.
constexpr int kAnswersToCall = 3;
constexpr int kMostAnswers = 10'000;

}  // namespace

Refusal FrameLimits::FromClient(std::string_view bytes, Time now) {
  now_ = now;
  return client_reader_.Read(bytes, from_client_);
}

Refusal FrameLimits::FromServer(std::string_view bytes, Time now) {
  now_ = now;
  return server_reader_.Read(bytes, from_server_);
}

Refusal FrameLimits::AtTime(Time now) const {
  const bool is_late = num_unacknowledged_ > 0 && now - unacknowledged_since_ > kAcknowledgeWithin;
  return is_late ? Refusal::kSettingsUnacknowledged : Refusal::kNone;
}

Refusal FrameLimits::OnClientHead(const FrameHead& head) {
  if (head.length_bytes > kMostFrame_bytes) return Refusal::kFrameTooLarge;
  if (block_stream_ != 0) return ContinueHeaders(head);
  switch (head.type) {
    case FrameType::kData: return head.length_bytes > 0 || head.Has(kEndStream) ? Refusal::kNone : Control();
    case FrameType::kHeaders: return BeginHeaders(head);
    case FrameType::kReset: return OnReset(head.stream);
    case FrameType::kSettings: return OnSettings(head);
    case FrameType::kPing:
    case FrameType::kWindowUpdate: return Answer();
    case FrameType::kPushPromise:  // only servers may send it
    case FrameType::kContinuation: return Refusal::kMalformed;
    default: return Control();
  }
}

Refusal FrameLimits::OnSettings(const FrameHead& head) {
  if (head.Has(kAck) && num_unacknowledged_ > 0) {
    --num_unacknowledged_;
    unacknowledged_since_ = now_;
  }
  return Control();
}

Refusal FrameLimits::BeginHeaders(const FrameHead& head) {
  if (head.stream == 0) return Refusal::kMalformed;
  if (head.stream > last_stream_) {
    last_stream_ = head.stream;
    if (streams_.size() >= kMostStreams) return Refusal::kTooManyStreams;
    streams_.push_back({.id = head.stream, .is_answered = false});
    num_answers_ = std::min(num_answers_ + kAnswersToCall, kMostAnswers);
  } else if (FindStream(head.stream) == streams_.end()) {
    if (const Refusal refusal = Control(); refusal != Refusal::kNone) return refusal;  // for a stream that has ended
  }
  block_stream_ = head.stream;
  block_bytes_ = head.length_bytes;
  num_block_frames_ = 1;
  is_last_of_block_ = head.Has(kEndHeaders);
  has_pad_length_ = head.Has(kPadded);
  before_fragment_bytes_ = (has_pad_length_ ? 1 : 0) + (head.Has(kPriority) ? 5 : 0);
  if (before_fragment_bytes_ > head.length_bytes) return Refusal::kMalformed;
  fragment_bytes_ = head.length_bytes - before_fragment_bytes_;
  check_.Begin();
  return Refusal::kNone;
}

/// No other frame may come before the end of the block (RFC 9113, 6.10).
Refusal FrameLimits::ContinueHeaders(const FrameHead& head) {
  if (head.type != FrameType::kContinuation || head.stream != block_stream_) return Refusal::kMalformed;
  block_bytes_ += head.length_bytes;
  if (++num_block_frames_ > kMostHeaderFrames || block_bytes_ > kMostHeaderBlock_bytes) return Refusal::kHeaderTooLarge;
  is_last_of_block_ = head.Has(kEndHeaders);
  before_fragment_bytes_ = 0;
  fragment_bytes_ = head.length_bytes;
  return Refusal::kNone;
}

Refusal FrameLimits::OnClientPayload(std::string_view part, bool is_end) {
  if (block_stream_ == 0) return Refusal::kNone;
  if (before_fragment_bytes_ > 0 && !part.empty()) {
    if (has_pad_length_) {
      has_pad_length_ = false;
      const auto padding_bytes = static_cast<std::uint8_t>(part.front());
      if (padding_bytes > fragment_bytes_) return Refusal::kMalformed;
      fragment_bytes_ -= padding_bytes;
    }
    const auto step = std::min<std::size_t>(part.size(), before_fragment_bytes_);
    before_fragment_bytes_ -= static_cast<std::uint32_t>(step);
    part.remove_prefix(step);
  }
  const std::string_view fragment = part.substr(0, fragment_bytes_);  // padding follows
  fragment_bytes_ -= static_cast<std::uint32_t>(fragment.size());
  if (const Refusal refusal = check_.Add(fragment); refusal != Refusal::kNone) return refusal;
  if (!is_end || !is_last_of_block_) return Refusal::kNone;
  block_stream_ = 0;
  return check_.is_between_fields() ? Refusal::kNone : Refusal::kBadHeader;
}

Refusal FrameLimits::OnServerHead(const FrameHead& head) {
  server_head_ = head;
  switch (head.type) {
    case FrameType::kData: num_answers_ = std::min(num_answers_ + kAnswersToData, kMostAnswers); break;
    case FrameType::kSettings:
      if (!head.Has(kAck) && num_unacknowledged_++ == 0) unacknowledged_since_ = now_;
      return Refusal::kNone;
    case FrameType::kReset: is_reset_for_cause_ = false; return Refusal::kNone;
    case FrameType::kHeaders:
      if (const auto found = FindStream(head.stream); found != streams_.end() && !found->is_answered) {
        found->is_answered = true;
        num_answers_ = std::min(num_answers_ + 1, kMostAnswers);
      }
      break;
    default: return Refusal::kNone;
  }
  if (head.Has(kEndStream)) CloseStream(head.stream);
  return Refusal::kNone;
}

/// A reset by the server because of the client's frames counts as a reset by the client: its call runs on all the
/// same.
Refusal FrameLimits::OnServerPayload(std::string_view part, bool is_end) {
  if (server_head_.type != FrameType::kReset) return Refusal::kNone;
  is_reset_for_cause_ |= std::any_of(part.begin(), part.end(), [](char byte) { return byte != 0; });  // not NO_ERROR
  if (!is_end) return Refusal::kNone;
  const bool was_open = CloseStream(server_head_.stream);
  return was_open && is_reset_for_cause_ ? Reset() : Refusal::kNone;
}

/// The peer's shared limit applies only to connections with many resets, so it does not punish the others of a busy
/// address. A client with many connections has kOwnResets on each, at the cost of a connection.
Refusal FrameLimits::Reset() {
  if (!resets_.Take(now_)) return Refusal::kTooManyResets;
  const bool is_one_too_many = peer_ != nullptr && resets_.has_given(kOwnResets) && !peer_->TakeReset(now_);
  return is_one_too_many ? Refusal::kTooManyResets : Refusal::kNone;
}

Refusal FrameLimits::Control() {
  if (!control_.Take(now_)) return Refusal::kTooManyControlFrames;
  const bool is_one_too_many = peer_ != nullptr && control_.is_half_empty() && !peer_->TakeControl(now_);
  return is_one_too_many ? Refusal::kTooManyControlFrames : Refusal::kNone;
}

Refusal FrameLimits::Answer() {
  if (num_answers_ == 0) return Control();
  --num_answers_;
  return Refusal::kNone;
}

std::vector<FrameLimits::OpenStream>::iterator FrameLimits::FindStream(std::uint32_t stream) {
  return std::find_if(streams_.begin(), streams_.end(), [stream](const OpenStream& one) { return one.id == stream; });
}

/// A call that is cancelled before its answer begins leaves useless work behind; a cancelled watch that has sent
/// messages does not.
Refusal FrameLimits::OnReset(std::uint32_t stream) {
  const auto found = FindStream(stream);
  const bool is_answered = found != streams_.end() && found->is_answered;
  if (!CloseStream(stream)) return Answer();
  return is_answered ? Answer() : Reset();
}

bool FrameLimits::CloseStream(std::uint32_t stream) {
  const auto found = FindStream(stream);
  if (found == streams_.end()) return false;
  *found = streams_.back();
  streams_.pop_back();
  return true;
}

}  // namespace dhpmap::net
