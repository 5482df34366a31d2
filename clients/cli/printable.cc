// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/printable.h"

#include <array>
#include <cstdint>
#include <cstdio>

#include "mapping/base/utf8.h"

namespace dhpmap {
namespace {

/// Length of the character in well-formed UTF-8.
std::size_t NumBytes(unsigned char first) { return first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4; }

std::uint32_t CodeOf(std::string_view character) {
  const auto first = static_cast<unsigned char>(character.front());
  if (character.size() == 1) return first;
  std::uint32_t code = first & (0x7Fu >> character.size());
  for (const char c : character.substr(1)) code = code << 6 | (static_cast<unsigned char>(c) & 0x3Fu);
  return code;
}

bool IsWithin(std::uint32_t code, std::uint32_t from, std::uint32_t to) { return code >= from && code <= to; }

/// Control characters, line ends and direction marks.
bool ActsOnATerminal(std::uint32_t code) {
  return code < 0x20 || IsWithin(code, 0x7F, 0x9F) || code == 0x061C || IsWithin(code, 0x200E, 0x200F) ||
         IsWithin(code, 0x2028, 0x202E) || IsWithin(code, 0x2066, 0x2069);
}

std::string Escaped(std::uint32_t code) {
  if (code == '\n') return "\\n";
  if (code == '\t') return "\\t";
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), code < 0x80 ? "\\x%02x" : "\\u%04x", code);
  return text.data();
}

std::string EscapedByte(char byte) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "\\x%02x", static_cast<unsigned char>(byte));
  return text.data();
}

}  // namespace

std::string Printable(std::string_view text) {
  std::string printable;
  printable.reserve(text.size());
  while (!text.empty()) {
    const std::size_t invalid = FindInvalidUtf8(text);
    for (std::string_view valid = text.substr(0, invalid); !valid.empty();) {
      const std::string_view character = valid.substr(0, NumBytes(static_cast<unsigned char>(valid.front())));
      const std::uint32_t code = CodeOf(character);
      printable += ActsOnATerminal(code) ? Escaped(code) : std::string(character);
      valid.remove_prefix(character.size());
    }
    if (invalid == std::string_view::npos) break;
    printable += EscapedByte(text[invalid]);
    text.remove_prefix(invalid + 1);
  }
  return printable;
}

}  // namespace dhpmap
