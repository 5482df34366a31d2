// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/header_check.h"

#include <algorithm>

namespace dhpmap::net {

Refusal HeaderCheck::Add(std::string_view fragment) {
  while (!fragment.empty()) {
    if (next_ == Next::kString) {
      const auto step = std::min<std::size_t>(fragment.size(), string_left_bytes_);
      fragment.remove_prefix(step);
      string_left_bytes_ -= static_cast<std::uint32_t>(step);
      if (string_left_bytes_ == 0) StringEnded();
      continue;
    }
    const auto byte = static_cast<std::uint8_t>(fragment.front());
    fragment.remove_prefix(1);
    Refusal refusal = Refusal::kNone;
    switch (next_) {
      case Next::kField: refusal = BeginField(byte); break;
      case Next::kInteger: refusal = AddToInteger(byte); break;
      case Next::kStringLength: refusal = BeginInteger(Integer::kLength, byte, 7); break;  // top bit: is it Huffman
      case Next::kString: break;
    }
    if (refusal != Refusal::kNone) return refusal;
  }
  return Refusal::kNone;
}

/// RFC 7541, section 6.
Refusal HeaderCheck::BeginField(std::uint8_t byte) {
  if (++num_fields_ > kMostFields) return Refusal::kHeaderTooLarge;
  if ((byte & 0x80) != 0) return BeginInteger(Integer::kIndex, byte, 7);
  if ((byte & 0xE0) == 0x20) return BeginInteger(Integer::kTableSize, byte, 5);
  const int prefix_bits = (byte & 0x40) != 0 ? 6 : 4;
  const bool has_name = (byte & ((1 << prefix_bits) - 1)) == 0;
  return BeginInteger(has_name ? Integer::kIndexBeforeName : Integer::kIndexBeforeValue, byte, prefix_bits);
}

/// RFC 7541, section 5.1.
Refusal HeaderCheck::BeginInteger(Integer meaning, std::uint8_t byte, int prefix_bits) {
  const std::uint32_t mask = (1u << prefix_bits) - 1;
  meaning_ = meaning;
  value_ = byte & mask;
  num_more_bytes_ = 0;
  if (value_ < mask) return IntegerEnded();
  next_ = Next::kInteger;
  return Refusal::kNone;
}

Refusal HeaderCheck::AddToInteger(std::uint8_t byte) {
  if (num_more_bytes_ == 3) return Refusal::kBadHeader;  // 21 bits exceed every limit
  value_ += static_cast<std::uint32_t>(byte & 0x7F) << (7 * num_more_bytes_++);
  if (value_ > kMostInteger) return Refusal::kBadHeader;
  return (byte & 0x80) != 0 ? Refusal::kNone : IntegerEnded();
}

Refusal HeaderCheck::IntegerEnded() {
  switch (meaning_) {
    case Integer::kIndex:
    case Integer::kTableSize: next_ = Next::kField; break;
    case Integer::kIndexBeforeValue:
    case Integer::kIndexBeforeName:
      num_strings_left_ = meaning_ == Integer::kIndexBeforeName ? 2 : 1;
      next_ = Next::kStringLength;
      break;
    case Integer::kLength:
      if (value_ > kMostString_bytes) return Refusal::kBadHeader;
      string_left_bytes_ = value_;
      next_ = Next::kString;
      if (value_ == 0) StringEnded();
      break;
  }
  return Refusal::kNone;
}

void HeaderCheck::StringEnded() { next_ = --num_strings_left_ > 0 ? Next::kStringLength : Next::kField; }

}  // namespace dhpmap::net
