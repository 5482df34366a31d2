// SPDX-License-Identifier: BSD-3-Clause
#include "server/json/base64.h"

#include <array>
#include <cstdint>

namespace dhpmap::json {
namespace {

constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t kBad = 0xFF;

constexpr std::array<std::uint8_t, 256> MakeValues() {
  std::array<std::uint8_t, 256> values{};
  for (auto& value : values) value = kBad;
  for (std::size_t i = 0; i < kAlphabet.size(); ++i) {
    values[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::uint8_t>(i);
  }
  values['-'] = 62;
  values['_'] = 63;
  return values;
}
constexpr std::array<std::uint8_t, 256> kValues = MakeValues();

std::uint32_t Byte(std::string_view bytes, std::size_t i) { return static_cast<unsigned char>(bytes[i]); }

}  // namespace

void AppendBase64(std::string_view bytes, std::string* out) {
  const std::size_t start = out->size();
  out->resize(start + (bytes.size() + 2) / 3 * 4, '=');
  char* to = out->data() + start;
  std::size_t i = 0;
  for (; i + 3 <= bytes.size(); i += 3, to += 4) {
    const std::uint32_t word = Byte(bytes, i) << 16 | Byte(bytes, i + 1) << 8 | Byte(bytes, i + 2);
    to[0] = kAlphabet[word >> 18];
    to[1] = kAlphabet[word >> 12 & 63];
    to[2] = kAlphabet[word >> 6 & 63];
    to[3] = kAlphabet[word & 63];
  }
  if (i == bytes.size()) return;
  const bool two = i + 2 == bytes.size();
  const std::uint32_t word = Byte(bytes, i) << 16 | (two ? Byte(bytes, i + 1) << 8 : 0);
  to[0] = kAlphabet[word >> 18];
  to[1] = kAlphabet[word >> 12 & 63];
  if (two) to[2] = kAlphabet[word >> 6 & 63];
}

std::optional<std::string> DecodeBase64(std::string_view text) {
  for (int i = 0; i < 2 && !text.empty() && text.back() == '='; ++i) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::string out(text.size() * 3 / 4, '\0');
  char* to = out.data();
  std::uint32_t word = 0;
  std::uint32_t seen = 0;  // OR of all values: one test at the end instead of one per character
  std::size_t i = 0;
  for (; i + 4 <= text.size(); i += 4, to += 3) {
    const std::uint32_t a = kValues[Byte(text, i)], b = kValues[Byte(text, i + 1)];
    const std::uint32_t c = kValues[Byte(text, i + 2)], d = kValues[Byte(text, i + 3)];
    seen |= a | b | c | d;
    word = a << 18 | b << 12 | c << 6 | d;
    to[0] = static_cast<char>(word >> 16);
    to[1] = static_cast<char>(word >> 8);
    to[2] = static_cast<char>(word);
  }
  const std::size_t left = text.size() - i;
  word = 0;
  for (std::size_t k = 0; k < left; ++k) {
    seen |= kValues[Byte(text, i + k)];
    word |= static_cast<std::uint32_t>(kValues[Byte(text, i + k)]) << (18 - 6 * k);
  }
  if (left >= 2) to[0] = static_cast<char>(word >> 16);
  if (left == 3) to[1] = static_cast<char>(word >> 8);
  if ((seen & 0x80u) != 0) return std::nullopt;
  return out;
}

}  // namespace dhpmap::json
