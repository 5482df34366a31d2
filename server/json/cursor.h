// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "mapping/base/status.h"

namespace dhpmap::json {

/// A strict tokenizer of RFC 8259 text. Every reading function returns false on the first error, which is kept with its
/// position; stop after it. Holds a view of the text. Thread-compatible.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}

  /// The next non-space character, not consumed; '\0' at the end.
  char Peek();
  [[nodiscard]] std::size_t offset() const { return offset_; }
  [[nodiscard]] std::string_view Slice(std::size_t from) const { return text_.substr(from, offset_ - from); }

  bool TryConsume(char c);
  bool Consume(char c);
  /// `*value` is a view of the text, or of `*scratch` if there were escapes. `scratch` null: only check the string.
  bool ReadString(std::string_view* value, std::string* scratch);
  /// The next string, with its escapes and without its quotes; empty if there is none.
  [[nodiscard]] std::string_view RawString();
  bool ReadNumber(std::string_view* value);
  /// "true", "false" or "null".
  bool ReadWord(std::string_view word);
  /// Skips any value, after checking it.
  bool SkipValue();
  bool ExpectEnd();

  /// Keeps the first error, at the current position or at `offset`. Returns false.
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

/// Limit of nesting, because nesting uses stack.
inline constexpr int kMaxDepth = 64;

}  // namespace dhpmap::json
