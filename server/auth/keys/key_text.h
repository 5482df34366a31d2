// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace dhpmap::auth {

/// Fills it with what nobody can guess. Passed in, so that tests know it.
using Randomness = std::function<void(std::span<unsigned char>)>;
/// The system's. Ends the process if there is none: there is nothing to go on with.
Randomness SystemRandomness();

/// 2 hexadecimal digits a byte, lower case.
std::string HexOf(std::span<const unsigned char> bytes);

/// SHA-256.
using Digest = std::array<unsigned char, 32>;
Digest DigestOf(std::string_view text);
std::optional<Digest> DigestFromHex(std::string_view hex);
/// In a time that does not depend on where they differ.
bool AreSame(const Digest& a, const Digest& b);

/// A key as its owner has it: dhp_<id>_<256 random bits>_<crc32>, all hexadecimal. The sum tells a slip of the pen from
/// a wrong key, and scanners of repositories what is no key.
struct KeyText {
  std::string_view id;      ///< 12 digits
  std::string_view secret;  ///< all but the sum: what is digested
};
inline constexpr std::size_t kKeyIdDigits = 12, kKeyTextBytes = 90;

std::string MakeKeyText(const Randomness& randomness);
/// Nothing if it is none. Views into `text`.
std::optional<KeyText> ParseKeyText(std::string_view text);

}  // namespace dhpmap::auth
