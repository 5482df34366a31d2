// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>

#include "server/net/refusal.h"

namespace dhpmap::net {

/// Scans HPACK (RFC 7541) without decoding it, in pieces of any size. Refuses integers and lengths above the limits of
/// a header block, and blocks of so many fields that small bytes expand to much. Stores no field; the cost is one step
/// per representation, none for the bytes of strings. Thread-compatible.
class HeaderCheck {
 public:
  static constexpr std::uint32_t kMostInteger = 65'536;
  static constexpr std::uint32_t kMostString_bytes = 16'384;
  static constexpr int kMostFields = 256;

  /// Starts a new block.
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
  int num_more_bytes_ = 0;    // of the current integer
  int num_strings_left_ = 0;  // of the current field
  std::uint32_t string_left_bytes_ = 0;
  int num_fields_ = 0;
};

}  // namespace dhpmap::net
