// SPDX-License-Identifier: BSD-3-Clause
#include "server/rest/message_splitter.h"

#include <algorithm>
#include <cstdint>

namespace dhpmap::rest {

void MessageSplitter::Add(std::string_view data) {
  if (too_large_ || broken_) return;
  if (start_ > 0) {
    buffer_.erase(0, start_);
    scanned_ -= start_;
    start_ = 0;
  }
  // One message at most may be kept; a stream's piece may hold the end of one and the start of the next.
  const std::size_t room = max_message_bytes_ + (is_stream_ ? data.size() : 0);
  if (buffer_.size() + data.size() > room) {
    too_large_ = true;
    std::string().swap(buffer_);
    return;
  }
  buffer_ += data;
}

std::optional<std::string> MessageSplitter::Next() {
  if (too_large_ || broken_) return std::nullopt;
  if (!is_stream_) return NextWhole();
  if (format_ == BodyFormat::kJson) return NextJson();
  if (format_ == BodyFormat::kDelimitedProtobuf) return NextDelimited();
  return ended_ && !buffer_.empty() ? NextWhole() : std::nullopt;
}

std::optional<std::string> MessageSplitter::NextWhole() {
  if (!ended_ || taken_) return std::nullopt;
  taken_ = true;
  std::string message;
  message.swap(buffer_);
  return message;
}

std::optional<std::string> MessageSplitter::Take(std::size_t skip, std::size_t size) {
  if (size > max_message_bytes_) {
    too_large_ = true;
    std::string().swap(buffer_);
    return std::nullopt;
  }
  std::string message = buffer_.substr(start_ + skip, size);
  start_ += skip + size;
  scanned_ = start_;
  depth_ = 0;
  in_string_ = after_backslash_ = false;
  return message;
}

std::optional<std::string> MessageSplitter::NextJson() {
  if (depth_ == 0) {
    start_ = std::min(buffer_.find_first_not_of(" \t\r\n", start_), buffer_.size());
    scanned_ = start_;
    if (start_ == buffer_.size()) return std::nullopt;
    if (buffer_[start_] != '{') {
      const std::size_t newline = buffer_.find('\n', start_);
      if (newline == std::string::npos && !ended_) return std::nullopt;
      return Take(0, std::min(newline, buffer_.size()) - start_);
    }
  }
  for (; scanned_ < buffer_.size(); ++scanned_) {
    const char c = buffer_[scanned_];
    if (after_backslash_) {
      after_backslash_ = false;
    } else if (in_string_) {
      in_string_ = c != '"';
      after_backslash_ = c == '\\';
    } else if (c == '"') {
      in_string_ = true;
    } else if (c == '{' || c == '[') {
      ++depth_;
    } else if ((c == '}' || c == ']') && --depth_ == 0) {
      return Take(0, scanned_ + 1 - start_);
    }
  }
  return ended_ ? Take(0, buffer_.size() - start_) : std::nullopt;
}

std::optional<std::string> MessageSplitter::NextDelimited() {
  if (start_ == buffer_.size()) return std::nullopt;
  std::uint64_t size = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    if (start_ + i >= buffer_.size()) {
      broken_ = ended_;
      return std::nullopt;
    }
    const auto byte = static_cast<unsigned char>(buffer_[start_ + i]);
    size |= static_cast<std::uint64_t>(byte & 0x7F) << (7 * i);
    if (byte >= 0x80) continue;
    if (size > max_message_bytes_) {
      too_large_ = true;
      return std::nullopt;
    }
    if (buffer_.size() - start_ - i - 1 >= size) return Take(i + 1, size);
    broken_ = ended_;
    return std::nullopt;
  }
  broken_ = true;
  return std::nullopt;
}

}  // namespace dhpmap::rest
