// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "mapping/base/status.h"

namespace dhpmap::json {

/// Walks the tokens of an RFC 8259 text, strictly. Every reading function returns false on the first error, which is
/// kept with its place; after that, stop. Keeps a view of the text. Thread-compatible.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}

  /// The next character that is not space, not consumed; '\0' at the end.
  char Peek();
  [[nodiscard]] std::size_t offset() const { return offset_; }
  [[nodiscard]] std::string_view Slice(std::size_t from) const { return text_.substr(from, offset_ - from); }

  bool TryConsume(char c);
  bool Consume(char c);
  /// `*value` is a view of the text, or of `*scratch` where there were escapes. `scratch` null: it is only checked.
  bool ReadString(std::string_view* value, std::string* scratch);
  /// The string that is next, with its escapes and without its quotes; empty if there is none.
  [[nodiscard]] std::string_view RawString();
  bool ReadNumber(std::string_view* value);
  /// "true", "false" or "null".
  bool ReadWord(std::string_view word);
  /// Any value, checked but not kept.
  bool SkipValue();
  bool ExpectEnd();

  /// Keeps the first error, at the present place or at `offset`. Returns false.
  bool Fail(std::string message) { return FailAt(offset_, std::move(message)); }
  bool FailAt(std::size_t offset, std::string message);
  [[nodiscard]] bool failed() const { return failed_; }
  /// INVALID_ARGUMENT "message, at line L, column C (byte B)"; OK if nothing failed.
  [[nodiscard]] Status status() const;

 private:
  bool ReadEscape(std::string* out);
  bool ReadHex4(unsigned* code);
  bool SkipNested(char close, bool has_keys);
  [[nodiscard]] std::string Described() const;

  std::string_view text_;
  std::size_t offset_ = 0;
  int depth_ = 0;
  bool failed_ = false;
  std::size_t error_offset_ = 0;
  std::string error_;
};

/// Deeper nesting is an error: it would cost stack.
inline constexpr int kMaxDepth = 64;

}  // namespace dhpmap::json
