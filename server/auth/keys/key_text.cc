// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/keys/key_text.h"

#include <openssl/crypto.h>
#include <openssl/rand.h>
#include <openssl/sha.h>
#include <zlib.h>

#include <algorithm>
#include <cstdlib>

namespace dhpmap::auth {
namespace {

constexpr std::string_view kPrefix = "dhp_";
constexpr std::size_t kSecretDigits = 64, kSumDigits = 8;
static_assert(kKeyTextBytes == kPrefix.size() + kKeyIdDigits + 1 + kSecretDigits + 1 + kSumDigits);

bool IsHex(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

std::string SumOf(std::string_view text) {
  const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size()));
  std::array<unsigned char, 4> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(sum >> (24 - 8 * i));
  return HexOf(bytes);
}

int Digit(char c) { return c <= '9' ? c - '0' : c - 'a' + 10; }

}  // namespace

Randomness SystemRandomness() {
  return [](std::span<unsigned char> bytes) {
    if (RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) != 1) std::abort();
  };
}

std::string HexOf(std::span<const unsigned char> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  text.reserve(2 * bytes.size());
  for (const unsigned char byte : bytes) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

Digest DigestOf(std::string_view text) {
  Digest digest{};
  SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(), digest.data());
  return digest;
}

std::optional<Digest> DigestFromHex(std::string_view hex) {
  Digest digest{};
  if (hex.size() != 2 * digest.size() || !IsHex(hex)) return std::nullopt;
  for (std::size_t i = 0; i < digest.size(); ++i) {
    digest[i] = static_cast<unsigned char>(16 * Digit(hex[2 * i]) + Digit(hex[2 * i + 1]));
  }
  return digest;
}

bool AreSame(const Digest& a, const Digest& b) { return CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0; }

std::string MakeKeyText(const Randomness& randomness) {
  std::array<unsigned char, (kKeyIdDigits + kSecretDigits) / 2> bytes{};
  randomness(bytes);
  const std::string digits = HexOf(bytes);
  const std::string text =
      std::string(kPrefix) + digits.substr(0, kKeyIdDigits) + "_" + digits.substr(kKeyIdDigits, kSecretDigits);
  OPENSSL_cleanse(bytes.data(), bytes.size());
  return text + "_" + SumOf(text);
}

std::optional<KeyText> ParseKeyText(std::string_view text) {
  if (text.size() != kKeyTextBytes || !text.starts_with(kPrefix)) return std::nullopt;
  const std::size_t secret = kPrefix.size() + kKeyIdDigits, sum = secret + 1 + kSecretDigits;
  const std::string_view id = text.substr(kPrefix.size(), kKeyIdDigits);
  if (text[secret] != '_' || text[sum] != '_' || !IsHex(id)) return std::nullopt;
  if (!IsHex(text.substr(secret + 1, kSecretDigits))) return std::nullopt;
  const std::string_view covered = text.substr(0, sum);
  if (text.substr(sum + 1) != SumOf(covered)) return std::nullopt;
  return KeyText{.id = id, .secret = covered};
}

}  // namespace dhpmap::auth
