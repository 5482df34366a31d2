// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace dhpmap {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// Appends little-endian values to a buffer; the same bytes on every machine.
class ByteWriter {
 public:
  explicit ByteWriter(Bytes& bytes) : bytes_(bytes) {}

  void PutU8(std::uint8_t value) { bytes_.push_back(value); }
  void PutU32(std::uint32_t value) { PutFixed(value); }
  void PutU64(std::uint64_t value) { PutFixed(value); }
  void PutF32(float value) { PutU32(std::bit_cast<std::uint32_t>(value)); }
  void PutF64(double value) { PutU64(std::bit_cast<std::uint64_t>(value)); }
  void PutBytes(ByteView value);
  /// 7 bits a byte, the lowest first, the top bit set on all but the last.
  void PutVarint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) PutU8(static_cast<std::uint8_t>(value | 0x80));
    PutU8(static_cast<std::uint8_t>(value));
  }
  /// Its length, then its bytes.
  void PutText(std::string_view text);

 private:
  template <typename Int>
  void PutFixed(Int value) {
    for (unsigned i = 0; i < sizeof(Int); ++i) bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  Bytes& bytes_;
};

/// Reads the output of a ByteWriter. Past the end, or at a varint of more than 64 bits, it returns zeros and sets
/// !ok().
class ByteReader {
 public:
  explicit ByteReader(ByteView bytes) : bytes_(bytes) {}

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::size_t remaining() const { return bytes_.size() - next_; }

  std::uint8_t GetU8() { return GetFixed<std::uint8_t>(); }
  std::uint32_t GetU32() { return GetFixed<std::uint32_t>(); }
  std::uint64_t GetU64() { return GetFixed<std::uint64_t>(); }
  float GetF32() { return std::bit_cast<float>(GetU32()); }
  double GetF64() { return std::bit_cast<double>(GetU64()); }
  std::uint64_t GetVarint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const std::uint8_t byte = GetU8();
      value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
      if (byte < 0x80) return value;
    }
    ok_ = false;
    return 0;
  }
  /// Fills `out`, with zeros if there are too few bytes.
  void GetInto(std::span<std::uint8_t> out) {
    const ByteView view = GetBytes(out.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = i < view.size() ? view[i] : std::uint8_t{0};
  }
  /// A view of the next `size` bytes; empty if there are fewer.
  ByteView GetBytes(std::size_t size) {
    if (size > remaining()) {
      ok_ = false;
      next_ = bytes_.size();
      return {};
    }
    const ByteView view = bytes_.subspan(next_, size);
    next_ += size;
    return view;
  }

 private:
  template <typename Int>
  Int GetFixed() {
    const ByteView view = GetBytes(sizeof(Int));
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < view.size(); ++i) value |= static_cast<std::uint64_t>(view[i]) << (8 * i);
    return static_cast<Int>(value);
  }

  ByteView bytes_;
  std::size_t next_ = 0;
  bool ok_ = true;
};

}  // namespace dhpmap
