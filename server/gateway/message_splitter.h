// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "server/gateway/media_type.h"

namespace dhpmap::gateway {

/// Cuts a body that arrives in pieces into its messages, looking at each byte once. JSON objects may follow each other
/// with or without newlines and may span lines; anything else is taken up to the end of its line, for the parser to
/// refuse. Of a file messages are what has come of it, at most 256 KiB; one at least. Thread-compatible.
class MessageSplitter {
 public:
  /// `is_stream` false: the whole body is one message, empty or not.
  MessageSplitter(BodyFormat format, bool is_stream, std::size_t max_message_bytes)
      : format_(format), is_stream_(is_stream), max_message_bytes_(max_message_bytes) {}

  void Add(std::string_view data);
  void AddEnd() { ended_ = true; }

  /// The next complete message, once; nothing if there is none (yet). What is left at the end comes as the last
  /// message.
  std::optional<std::string> Next();

  [[nodiscard]] bool ended() const { return ended_; }
  /// Whether nothing but space has come after the messages that were taken.
  [[nodiscard]] bool has_nothing_left() const;
  [[nodiscard]] std::size_t buffered_bytes() const { return buffer_.size(); }
  /// A message is larger than allowed; what came of it has been let go.
  [[nodiscard]] bool is_too_large() const { return fault_ == Fault::kTooLarge; }
  /// A length-delimited message that is cut off, or whose length is no varint.
  [[nodiscard]] bool is_broken() const { return fault_ == Fault::kBroken; }

 private:
  enum class Fault { kNone, kTooLarge, kBroken };
  /// Where in JSON text the scan is.
  enum class Scan {
    kBetween,      ///< before a message
    kLine,         ///< in one that starts with no brace: it ends with its line
    kObject,       ///< in an object, outside of strings
    kString,       ///< in a string of it
    kAfterEscape,  ///< after a backslash in that
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
  std::size_t start_ = 0;    // of what is not taken yet
  std::size_t scanned_ = 0;  // JSON: no byte before this is looked at again
  Scan scan_ = Scan::kBetween;
  int depth_ = 0;  // of the object
  bool ended_ = false;
  bool taken_ = false;  // the one message of what is no stream, or one of a file
  Fault fault_ = Fault::kNone;
};

}  // namespace dhpmap::gateway
