// SPDX-License-Identifier: BSD-3-Clause
// Bodies of many messages (JSON, NDJSON, length-delimited): cut in the same places however they arrive.
#include <algorithm>
#include <string_view>

#include "server/gateway/message_splitter.h"
#include "tests/fuzz/fuzz_target.h"

namespace dhpmap {
namespace {

constexpr std::size_t kMaxMessage_bytes = 300;

struct Outcome {
  std::vector<std::string> messages;
  bool is_too_large = false, is_broken = false;
};

Outcome Split(gateway::BodyFormat format, std::string_view body, std::size_t piece_bytes) {
  gateway::MessageSplitter splitter(format, true, kMaxMessage_bytes);
  Outcome outcome;
  const auto take = [&] {
    while (auto message = splitter.Next()) {
      fuzz::Require(message->size() <= kMaxMessage_bytes);
      outcome.messages.push_back(std::move(*message));
    }
  };
  for (std::size_t at = 0; at < body.size(); at += piece_bytes) {
    splitter.Add(body.substr(at, piece_bytes));
    take();
  }
  splitter.AddEnd();
  take();
  outcome.is_too_large = splitter.is_too_large();
  outcome.is_broken = splitter.is_broken();
  return outcome;
}

/// Of a literal, with the zeros in it.
template <std::size_t n>
std::string Bytes(const char (&text)[n]) {
  return {text, n - 1};
}

}  // namespace

std::vector<std::string> fuzz::Seeds() {
  return {Bytes("\1\0{\"a\":1}\n{\"b\":[\"}\\\"\"]}\n\nx\n{\"c\":{}}"), Bytes("\5\1\2ab\0\1c\x80"), Bytes("\3\0{\"a\""),
          Bytes("\1\1\xac\2") + std::string(300, 'y')};
}

}  // namespace dhpmap

// The first byte is the size of the pieces, the second the format.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dhpmap;
  if (size < 2) return 0;
  const std::string_view body(reinterpret_cast<const char*>(data) + 2, size - 2);
  const auto format = data[1] % 2 == 0 ? gateway::BodyFormat::kJson : gateway::BodyFormat::kDelimitedProtobuf;
  const Outcome pieces = Split(format, body, 1u + data[0]);
  const Outcome bytes = Split(format, body, 1);
  if (pieces.is_too_large || bytes.is_too_large) return 0;  // how much was taken before depends on the pieces
  fuzz::Require(pieces.messages == bytes.messages && pieces.is_broken == bytes.is_broken);
  return 0;
}
