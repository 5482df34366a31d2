// SPDX-License-Identifier: BSD-3-Clause
// HTTP/2 frames of both sides, and HPACK, at the door's limits: the same is said whatever the pieces, nothing that was
// taken is beyond the bounds, and a plain second reading agrees about where frames are.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "server/net/frame_limits.h"
#include "server/net/frame_reader.h"
#include "server/net/header_check.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/unit/server/net/http2_bytes.h"

namespace dhpmap {
namespace {

using net::FrameHead;
using net::FrameLimits;
using net::FrameType;
using net::Refusal;

/// Notes every frame, and refuses none.
class Notes final : public net::FrameSink {
 public:
  Refusal OnHead(const FrameHead& head) override {
    heads.push_back(std::to_string(head.length_bytes) + " " + std::to_string(static_cast<int>(head.type)) + " " +
                    std::to_string(head.flags) + " " + std::to_string(head.stream));
    return Refusal::kNone;
  }
  Refusal OnPayload(std::string_view part, bool is_end) override {
    payload += part;
    num_ends += is_end ? 1 : 0;
    return Refusal::kNone;
  }
  bool operator==(const Notes& other) const {
    return heads == other.heads && payload == other.payload && num_ends == other.num_ends;
  }

  std::vector<std::string> heads;
  std::string payload;
  int num_ends = 0;
};

Notes NotesInPieces(std::string_view bytes, std::size_t piece_bytes) {
  Notes notes;
  net::FrameReader reader;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(piece_bytes, bytes.size()))) {
    (void)reader.Read(bytes.substr(0, piece_bytes), notes);
  }
  return notes;
}

/// The obvious way, of all bytes at once.
std::size_t CountFrames(std::string_view bytes) {
  std::size_t count = 0;
  while (bytes.size() >= 9) {
    const auto byte = [&bytes](std::size_t i) {
      return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i]));
    };
    const std::size_t length = byte(0) << 16 | byte(1) << 8 | byte(2);
    bytes.remove_prefix(std::min(bytes.size(), 9 + length));
    ++count;
  }
  return count;
}

/// `sides`: whose turn each piece is, a bit each.
Refusal LimitsInPieces(std::string_view bytes, std::size_t piece_bytes, bool is_server_first) {
  FrameLimits limits(nullptr);
  const auto now = FrameLimits::Time() + std::chrono::seconds(1000);
  if (is_server_first) (void)limits.FromServer(bytes, now);
  for (; !bytes.empty(); bytes.remove_prefix(std::min(piece_bytes, bytes.size()))) {
    const Refusal refusal = limits.FromClient(bytes.substr(0, piece_bytes), now);
    fuzz::Require(limits.num_streams() <= FrameLimits::kMostStreams);
    if (refusal != Refusal::kNone) return refusal;
  }
  return Refusal::kNone;
}

Refusal HeadersInPieces(std::string_view bytes, std::size_t piece_bytes) {
  net::HeaderCheck check;
  check.Begin();
  for (; !bytes.empty(); bytes.remove_prefix(std::min(piece_bytes, bytes.size()))) {
    const Refusal refusal = check.Add(bytes.substr(0, piece_bytes));
    if (refusal != Refusal::kNone) return refusal;
  }
  return check.is_between_fields() ? Refusal::kNone : Refusal::kBadHeader;
}

}  // namespace

std::vector<std::string> fuzz::Seeds() {
  using namespace net::frame_flags;
  using testing::FrameBytes;
  const std::string fields = testing::CallFields("/dhpmap.v1.MapService/GetMap");
  const std::string call = FrameBytes(FrameType::kSettings, 0, 0) + FrameBytes(FrameType::kSettings, kAck, 0) +
                           FrameBytes(FrameType::kHeaders, kEndHeaders, 1, fields) +
                           FrameBytes(FrameType::kData, kEndStream, 1, std::string("\0\0\0\0\0", 5));
  std::vector<std::string> seeds;
  const auto add = [&seeds](char piece, const std::string& bytes) { seeds.emplace_back(1, piece).append(bytes); };
  add(1, call);
  add(3, call + FrameBytes(FrameType::kReset, 0, 1, std::string("\0\0\0\x08", 4)));
  add(5, FrameBytes(FrameType::kHeaders, 0, 1, "\x82") + FrameBytes(FrameType::kContinuation, kEndHeaders, 1, fields));
  add(7, FrameBytes(FrameType::kHeaders, kEndHeaders | kPadded | kPriority, 3,
                    "\x02"
                    "12345\x82\x86**"));
  add(2, FrameBytes(FrameType::kPing, 0, 0, "12345678") + FrameBytes(FrameType::kWindowUpdate, 0, 0, "1234"));
  add(4, FrameBytes(FrameType::kGoAway, 0, 0, "12345678bye"));
  add(6, fields);
  add(1, "\x40\x81\x0f\x82\x0f\x0f\x3f\xe1\x1f\x44\x7f\xad\x01");
  return seeds;
}

}  // namespace dhpmap

// The first byte is the size of the pieces; its lowest bit says whether the server has sent the same before.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dhpmap;
  if (size < 1) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::size_t piece_bytes = 1u + data[0];
  const bool is_server_first = (data[0] & 1) != 0;
  const Notes whole = NotesInPieces(bytes, bytes.size() + 1);
  fuzz::Require(whole.heads.size() == CountFrames(bytes));
  fuzz::Require(NotesInPieces(bytes, piece_bytes) == whole && NotesInPieces(bytes, 1) == whole);
  const Refusal said = LimitsInPieces(bytes, bytes.size() + 1, is_server_first);
  fuzz::Require(LimitsInPieces(bytes, piece_bytes, is_server_first) == said);
  fuzz::Require(LimitsInPieces(bytes, 1, is_server_first) == said);
  const Refusal headers = HeadersInPieces(bytes, bytes.size() + 1);
  fuzz::Require(HeadersInPieces(bytes, piece_bytes) == headers && HeadersInPieces(bytes, 1) == headers);
  return 0;
}
