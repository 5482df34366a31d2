// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace dhpmap::auth {

/// Fills the bytes with unpredictable values. Injected, so that tests know them.
using Randomness = std::function<void(std::span<unsigned char>)>;
/// The system's random source. Ends the process if that fails, because no secret can be made without it.
Randomness SystemRandomness();

/// 2 hexadecimal digits a byte, lower case.
std::string HexOf(std::span<const unsigned char> bytes);

/// SHA-256.
using Digest = std::array<unsigned char, 32>;
Digest DigestOf(std::string_view text);
std::optional<Digest> DigestFromHex(std::string_view hex);
/// In constant time, wherever they differ.
bool AreSame(const Digest& a, const Digest& b);

/// A key in its owner's form: dhp_<id>_<256 random bits>_<crc32>, all hexadecimal. The checksum tells a typing error
/// from a wrong key, and lets scanners of repositories recognise keys.
struct KeyText {
  std::string_view id;      ///< 12 digits
  std::string_view secret;  ///< all but the checksum: the part that is hashed
};
inline constexpr std::size_t kKeyIdDigits = 12, kKeyTextBytes = 90;

std::string MakeKeyText(const Randomness& randomness);
/// Nothing if the text is not a key. Views into `text`.
std::optional<KeyText> ParseKeyText(std::string_view text);

}  // namespace dhpmap::auth
