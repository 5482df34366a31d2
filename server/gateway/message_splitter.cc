// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/message_splitter.h"

#include <algorithm>
#include <cstdint>

namespace dhpmap::gateway {
namespace {

constexpr char kSpace[] = " \t\r\n";
constexpr std::size_t kFilePart_bytes = 256u << 10;

}  // namespace

void MessageSplitter::Add(std::string_view data) {
  if (fault_ != Fault::kNone) return;
  if (start_ > 0) {
    buffer_.erase(0, start_);
    scanned_ -= start_;
    start_ = 0;
  }
  // Keep at most one message; a piece of a stream may end one message and start the next.
  const std::size_t room = max_message_bytes_ + (is_stream_ ? data.size() : 0);
  if (buffer_.size() + data.size() > room) {
    Fail(Fault::kTooLarge);
    return;
  }
  buffer_ += data;
}

std::nullopt_t MessageSplitter::Fail(Fault fault) {
  fault_ = fault;
  std::string().swap(buffer_);
  return std::nullopt;
}

std::optional<std::string> MessageSplitter::Next() {
  if (fault_ != Fault::kNone) return std::nullopt;
  if (!is_stream_) return NextWhole();
  if (format_ == BodyFormat::kJson) return NextJson();
  if (format_ == BodyFormat::kDelimitedProtobuf) return NextDelimited();
  if (format_ == BodyFormat::kFile) return NextOfFile();
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
  if (size > max_message_bytes_) return Fail(Fault::kTooLarge);
  const std::size_t begin = start_ + skip, end = begin + size;
  std::string message;
  if (size > buffer_.size() / 2) {  // copy the smaller rest, and do not hold a large message twice
    std::string rest = buffer_.substr(end);
    message.swap(buffer_);
    message.resize(end);
    message.erase(0, begin);
    buffer_.swap(rest);
    start_ = 0;
  } else {
    message = buffer_.substr(begin, size);
    start_ = end;
  }
  scanned_ = start_;
  scan_ = Scan::kBetween;
  return message;
}

std::optional<std::string> MessageSplitter::NextJson() {
  if (scan_ == Scan::kBetween && !SkipToMessage()) return std::nullopt;
  const bool is_whole = scan_ == Scan::kLine ? ScanLine() : ScanObject();
  if (!is_whole && !ended_) return std::nullopt;
  return Take(0, scanned_ - start_);
}

bool MessageSplitter::has_nothing_left() const {
  return buffer_.find_first_not_of(format_ == BodyFormat::kJson ? kSpace : "", start_) == std::string::npos;
}

/// False if only whitespace is left.
bool MessageSplitter::SkipToMessage() {
  start_ = std::min(buffer_.find_first_not_of(kSpace, scanned_), buffer_.size());
  scanned_ = start_;
  if (start_ == buffer_.size()) return false;
  scan_ = buffer_[start_] == '{' ? Scan::kObject : Scan::kLine;
  depth_ = 0;
  return true;
}

/// Scans to the newline, or to the end of the data so far.
bool MessageSplitter::ScanLine() {
  const std::size_t newline = buffer_.find('\n', scanned_);
  scanned_ = std::min(newline, buffer_.size());
  return newline != std::string::npos;
}

/// Scans past the closing brace, or to the end of the data so far.
bool MessageSplitter::ScanObject() {
  while (scanned_ < buffer_.size()) {
    const char c = buffer_[scanned_++];
    switch (scan_) {
      case Scan::kAfterEscape: scan_ = Scan::kString; break;
      case Scan::kString:
        if (c == '"') scan_ = Scan::kObject;
        if (c == '\\') scan_ = Scan::kAfterEscape;
        break;
      default:
        if (c == '"') scan_ = Scan::kString;
        if (c == '{' || c == '[') ++depth_;
        if ((c == '}' || c == ']') && --depth_ == 0) return true;
    }
  }
  return false;
}

std::optional<std::string> MessageSplitter::NextOfFile() {
  const std::size_t size = std::min(buffer_.size() - start_, kFilePart_bytes);
  if (size == 0 && (!ended_ || taken_)) return std::nullopt;
  taken_ = true;
  return Take(0, size);
}

std::optional<std::string> MessageSplitter::NextDelimited() {
  if (start_ == buffer_.size()) return std::nullopt;
  std::uint64_t size = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    if (start_ + i >= buffer_.size()) {
      if (ended_) fault_ = Fault::kBroken;
      return std::nullopt;
    }
    const auto byte = static_cast<unsigned char>(buffer_[start_ + i]);
    size |= static_cast<std::uint64_t>(byte & 0x7F) << (7 * i);
    if (byte >= 0x80) continue;
    if (size > max_message_bytes_) return Fail(Fault::kTooLarge);
    if (buffer_.size() - start_ - i - 1 >= size) return Take(i + 1, size);
    if (ended_) fault_ = Fault::kBroken;
    return std::nullopt;
  }
  return Fail(Fault::kBroken);
}

}  // namespace dhpmap::gateway
