// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "server/gateway/media_type.h"

namespace dhpmap::gateway {

/// Splits a body that arrives in pieces into messages; scans each byte once. JSON objects may follow each other with or
/// without newlines and may span lines. Other text is taken up to the end of its line, and the parser refuses it. A
/// file is split as it arrives, into messages of at most 256 KiB, at least one. Thread-compatible.
class MessageSplitter {
 public:
  /// `is_stream` false: the whole body is one message, possibly empty.
  MessageSplitter(BodyFormat format, bool is_stream, std::size_t max_message_bytes)
      : format_(format), is_stream_(is_stream), max_message_bytes_(max_message_bytes) {}

  void Add(std::string_view data);
  void AddEnd() { ended_ = true; }

  /// Takes the next complete message; nothing if there is none yet. After AddEnd the rest is the last message.
  std::optional<std::string> Next();

  [[nodiscard]] bool ended() const { return ended_; }
  /// Whether only whitespace follows the messages taken so far.
  [[nodiscard]] bool has_nothing_left() const;
  [[nodiscard]] std::size_t buffered_bytes() const { return buffer_.size(); }
  /// A message exceeds the limit; the data received of it were dropped.
  [[nodiscard]] bool is_too_large() const { return fault_ == Fault::kTooLarge; }
  /// A length-delimited message is truncated, or its length is not a varint.
  [[nodiscard]] bool is_broken() const { return fault_ == Fault::kBroken; }

 private:
  enum class Fault { kNone, kTooLarge, kBroken };
  /// State of the scan in JSON text.
  enum class Scan {
    kBetween,      ///< before a message
    kLine,         ///< in a message that does not begin with a brace: it ends with its line
    kObject,       ///< in an object, outside of strings
    kString,       ///< in a string of the object
    kAfterEscape,  ///< after a backslash in a string
  };

  std::optional<std::string> NextWhole();
  std::optional<std::string> NextJson();
  std::optional<std::string> NextDelimited();
  std::optional<std::string> NextOfFile();
  std::optional<std::string> Take(std::size_t skip, std::size_t size);
  std::nullopt_t Fail(Fault fault);
  bool SkipToMessage();
  bool ScanLine();
  bool ScanObject();

  BodyFormat format_;
  bool is_stream_;
  std::size_t max_message_bytes_;
  std::string buffer_;
  std::size_t start_ = 0;    // start of the data not taken yet
  std::size_t scanned_ = 0;  // JSON: bytes before this are not scanned again
  Scan scan_ = Scan::kBetween;
  int depth_ = 0;  // of nested braces
  bool ended_ = false;
  bool taken_ = false;  // not a stream: the message was taken; a file: at least one was
  Fault fault_ = Fault::kNone;
};

}  // namespace dhpmap::gateway
