// SPDX-License-Identifier: BSD-3-Clause
#include "server/json/cursor.h"

#include <algorithm>

namespace dhpmap::json {
namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

void AppendUtf8(unsigned code, std::string* out) {
  if (code < 0x80) {
    *out += static_cast<char>(code);
  } else if (code < 0x800) {
    *out += static_cast<char>(0xC0 | code >> 6);
    *out += static_cast<char>(0x80 | (code & 63));
  } else if (code < 0x10000) {
    *out += static_cast<char>(0xE0 | code >> 12);
    *out += static_cast<char>(0x80 | (code >> 6 & 63));
    *out += static_cast<char>(0x80 | (code & 63));
  } else {
    *out += static_cast<char>(0xF0 | code >> 18);
    *out += static_cast<char>(0x80 | (code >> 12 & 63));
    *out += static_cast<char>(0x80 | (code >> 6 & 63));
    *out += static_cast<char>(0x80 | (code & 63));
  }
}

}  // namespace

char Cursor::Peek() {
  while (offset_ < text_.size()) {
    const char c = text_[offset_];
    if (c != ' ' && c != '\n' && c != '\t' && c != '\r') return c;
    ++offset_;
  }
  return '\0';
}

bool Cursor::TryConsume(char c) {
  if (Peek() != c || offset_ >= text_.size()) return false;
  ++offset_;
  return true;
}

bool Cursor::Consume(char c) {
  if (TryConsume(c)) return true;
  return Fail(std::string("expected '") + c + "' but found " + Described());
}

std::string Cursor::Described() const {
  if (offset_ >= text_.size()) return "the end of the text";
  const auto c = static_cast<unsigned char>(text_[offset_]);
  if (c < 0x20 || c >= 0x7F) return "byte " + std::to_string(c);
  return std::string("'") + static_cast<char>(c) + "'";
}

bool Cursor::ReadString(std::string_view* value, std::string* scratch) {
  if (Peek() != '"') return Fail("expected a string but found " + Described());
  const std::size_t start = ++offset_;
  const bool is_kept = scratch != nullptr;
  if (is_kept) scratch->clear();
  std::string dropped;
  std::size_t run = start;
  while (offset_ < text_.size()) {
    const char c = text_[offset_];
    if (c == '"') {
      const bool has_no_escape = run == start;
      if (is_kept && !has_no_escape) scratch->append(text_, run, offset_ - run);
      if (is_kept) *value = has_no_escape ? text_.substr(start, offset_ - start) : std::string_view(*scratch);
      ++offset_;
      return true;
    }
    if (static_cast<unsigned char>(c) < 0x20) return Fail("a control character must be escaped in a string");
    if (c != '\\') {
      ++offset_;
      continue;
    }
    if (is_kept) scratch->append(text_, run, offset_ - run);
    dropped.clear();
    if (!ReadEscape(is_kept ? scratch : &dropped)) return false;
    run = offset_;
  }
  return FailAt(start - 1, "this string does not end");
}

std::string_view Cursor::RawString() {
  if (Peek() != '"') return {};
  const std::size_t start = offset_ + 1;
  std::size_t end = text_.find('"', start);
  const auto is_escaped = [&] {
    std::size_t num_backslashes = 0;
    while (end - num_backslashes > start && text_[end - num_backslashes - 1] == '\\') ++num_backslashes;
    return num_backslashes % 2 == 1;
  };
  while (end != std::string_view::npos && is_escaped()) end = text_.find('"', end + 1);
  return text_.substr(start, end == std::string_view::npos ? end : end - start);
}

bool Cursor::ReadEscape(std::string* out) {
  const std::size_t start = offset_++;
  const char kind = offset_ < text_.size() ? text_[offset_] : '\0';
  ++offset_;
  switch (kind) {
    case '"':
    case '\\':
    case '/': *out += kind; return true;
    case 'b': *out += '\b'; return true;
    case 'f': *out += '\f'; return true;
    case 'n': *out += '\n'; return true;
    case 'r': *out += '\r'; return true;
    case 't': *out += '\t'; return true;
    case 'u': break;
    default: return FailAt(start, "unknown escape in a string");
  }
  unsigned code = 0;
  if (!ReadHex4(&code)) return FailAt(start, "\\u needs four hexadecimal digits");
  if (code >= 0xD800 && code < 0xDC00) {
    unsigned low = 0;
    if (text_.substr(offset_, 2) != "\\u") return FailAt(start, "half of a surrogate pair");
    offset_ += 2;
    if (!ReadHex4(&low) || low < 0xDC00 || low > 0xDFFF) return FailAt(start, "half of a surrogate pair");
    code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
  } else if (code >= 0xDC00 && code < 0xE000) {
    return FailAt(start, "half of a surrogate pair");
  }
  AppendUtf8(code, out);
  return true;
}

bool Cursor::ReadHex4(unsigned* code) {
  if (offset_ + 4 > text_.size()) return false;
  *code = 0;
  for (int i = 0; i < 4; ++i) {
    const char c = text_[offset_++];
    const char lower = static_cast<char>(c | 0x20);
    if (IsDigit(c)) {
      *code = *code * 16 + static_cast<unsigned>(c - '0');
    } else if (lower >= 'a' && lower <= 'f') {
      *code = *code * 16 + static_cast<unsigned>(lower - 'a' + 10);
    } else {
      return false;
    }
  }
  return true;
}

bool Cursor::ReadNumber(std::string_view* value) {
  Peek();
  const std::size_t start = offset_;
  std::size_t i = offset_;
  const auto digits = [&] {
    const std::size_t from = i;
    while (i < text_.size() && IsDigit(text_[i])) ++i;
    return i - from;
  };
  if (i < text_.size() && text_[i] == '-') ++i;
  const std::size_t first = i;
  const std::size_t whole = digits();
  if (whole == 0) return Fail("expected a number but found " + Described());
  if (whole > 1 && text_[first] == '0') return Fail("a number must not start with 0");
  if (i < text_.size() && text_[i] == '.') {
    ++i;
    if (digits() == 0) return Fail("digits must follow the decimal point");
  }
  if (i < text_.size() && (text_[i] == 'e' || text_[i] == 'E')) {
    ++i;
    if (i < text_.size() && (text_[i] == '+' || text_[i] == '-')) ++i;
    if (digits() == 0) return Fail("digits must follow the exponent");
  }
  offset_ = i;
  *value = text_.substr(start, i - start);
  return true;
}

bool Cursor::ReadWord(std::string_view word) {
  Peek();
  if (text_.substr(offset_, word.size()) != word) return Fail("expected " + std::string(word));
  offset_ += word.size();
  return true;
}

bool Cursor::SkipValue() {
  std::string_view view;
  switch (Peek()) {
    case '{': return SkipNested('}', true);
    case '[': return SkipNested(']', false);
    case '"': return ReadString(nullptr, nullptr);
    case 't': return ReadWord("true");
    case 'f': return ReadWord("false");
    case 'n': return ReadWord("null");
    default: return ReadNumber(&view);
  }
}

bool Cursor::SkipNested(char close, bool has_keys) {
  if (++depth_ > kMaxDepth) return Fail("nested too deeply");
  ++offset_;
  if (!TryConsume(close)) {
    do {
      if (has_keys && (!ReadString(nullptr, nullptr) || !Consume(':'))) return false;
      if (!SkipValue()) return false;
    } while (TryConsume(','));
    if (!Consume(close)) return false;
  }
  --depth_;
  return true;
}

bool Cursor::ExpectEnd() {
  Peek();
  return offset_ >= text_.size() || Fail("unexpected " + Described() + " after the end of the value");
}

bool Cursor::FailAt(std::size_t offset, std::string message) {
  if (failed_) return false;
  failed_ = true;
  error_offset_ = std::min(offset, text_.size());
  error_ = std::move(message);
  return false;
}

Status Cursor::status() const {
  if (!failed_) return Status::Ok();
  const std::string_view before = text_.substr(0, error_offset_);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  return InvalidArgument(error_ + ", at line " + std::to_string(line) + ", column " +
                         std::to_string(error_offset_ - line_start + 1) + " (byte " + std::to_string(error_offset_) +
                         ")");
}

}  // namespace dhpmap::json
