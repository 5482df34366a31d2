// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>

#include "server/net/refusal.h"

namespace dhpmap::net {

/// Walks over HPACK (RFC 7541) without decoding it, whatever pieces it comes in: no integer and no declared length
/// beyond what a header block may have, and not so many fields that one byte each makes much of them. Keeps nothing of
/// the fields; costs a step a representation, and nothing for the bytes of strings. Thread-compatible.
class HeaderCheck {
 public:
  static constexpr std::uint32_t kMostInteger = 65'536;
  static constexpr std::uint32_t kMostString_bytes = 16'384;
  static constexpr int kMostFields = 256;

  /// A new block.
  void Begin() { *this = HeaderCheck(); }
  Refusal Add(std::string_view fragment);
  /// Whether the block may end here.
  [[nodiscard]] bool is_between_fields() const { return next_ == Next::kField; }

 private:
  enum class Next { kField, kInteger, kStringLength, kString };
  enum class Integer { kIndex, kIndexBeforeValue, kIndexBeforeName, kTableSize, kLength };

  Refusal BeginField(std::uint8_t byte);
  Refusal BeginInteger(Integer meaning, std::uint8_t byte, int prefix_bits);
  Refusal AddToInteger(std::uint8_t byte);
  Refusal IntegerEnded();
  void StringEnded();

  Next next_ = Next::kField;
  Integer meaning_ = Integer::kIndex;
  std::uint32_t value_ = 0;
  int num_more_bytes_ = 0;    // of the integer
  int num_strings_left_ = 0;  // of the field
  std::uint32_t string_left_bytes_ = 0;
  int num_fields_ = 0;
};

}  // namespace dhpmap::net
