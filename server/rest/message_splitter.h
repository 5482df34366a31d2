// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "server/rest/media_type.h"

namespace dhpmap::rest {

/// Cuts a body that arrives in pieces into its messages, without looking into them. JSON objects may follow each other
/// with or without newlines and may span lines; anything else is taken up to the end of its line, for the parser to
/// refuse. Thread-compatible.
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
  /// A message is larger than allowed; what came of it has been let go.
  [[nodiscard]] bool is_too_large() const { return too_large_; }
  /// A length-delimited message that is cut off, or whose length is no varint.
  [[nodiscard]] bool is_broken() const { return broken_; }

 private:
  std::optional<std::string> NextWhole();
  std::optional<std::string> NextJson();
  std::optional<std::string> NextDelimited();
  std::optional<std::string> Take(std::size_t skip, std::size_t size);

  BodyFormat format_;
  bool is_stream_;
  std::size_t max_message_bytes_;
  std::string buffer_;
  std::size_t start_ = 0;    // of what is not taken yet
  std::size_t scanned_ = 0;  // JSON: from start_ to here the state below holds
  int depth_ = 0;
  bool in_string_ = false;
  bool after_backslash_ = false;
  bool ended_ = false;
  bool taken_ = false;
  bool too_large_ = false;
  bool broken_ = false;
};

}  // namespace dhpmap::rest
