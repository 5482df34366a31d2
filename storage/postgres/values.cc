// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/values.h"

#include <bit>

namespace dhpmap::postgres {
namespace {

// Numbers of PostgreSQL's built-in types, which never change.
constexpr unsigned kInt8 = 20, kFloat8 = 701, kText = 25, kBytea = 17, kInt8Array = 1016;

}  // namespace

void Values::Begin(unsigned type) { places_.push_back({.type = type, .first = bytes_.size()}); }

void Values::End() { places_.back().length = static_cast<int>(bytes_.size() - places_.back().first); }

/// Big-endian.
void Values::Append(std::uint64_t value, int num_bytes) {
  for (int shift = 8 * (num_bytes - 1); shift >= 0; shift -= 8) bytes_.push_back(static_cast<char>(value >> shift));
}

void Values::PutInt(std::int64_t value) {
  Begin(kInt8);
  Append(static_cast<std::uint64_t>(value), 8);
  End();
}

void Values::PutReal(double value) {
  Begin(kFloat8);
  Append(std::bit_cast<std::uint64_t>(value), 8);
  End();
}

void Values::PutText(std::string_view text) {
  Begin(kText);
  bytes_.append(text);
  End();
}

void Values::PutCopy(std::span<const std::uint8_t> bytes) {
  Begin(kBytea);
  bytes_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  End();
}

Values& Values::Add(std::span<const std::int64_t> numbers) {
  Begin(kInt8Array);
  Append(numbers.empty() ? 0 : 1, 4);  // dimensions
  Append(0, 4);                        // no nulls
  Append(kInt8, 4);
  if (!numbers.empty()) {
    Append(numbers.size(), 4);
    Append(1, 4);  // the first index
  }
  for (const std::int64_t number : numbers) {
    Append(8, 4);
    Append(static_cast<std::uint64_t>(number), 8);
  }
  End();
  return *this;
}

std::vector<unsigned> Values::Types() const {
  std::vector<unsigned> types;
  for (const Place& place : places_) types.push_back(place.type);
  return types;
}

std::vector<int> Values::Lengths() const {
  std::vector<int> lengths;
  for (const Place& place : places_) lengths.push_back(place.length);
  return lengths;
}

std::vector<const char*> Values::Pointers() const {
  std::vector<const char*> pointers;
  for (const Place& place : places_) pointers.push_back(bytes_.data() + place.first);
  return pointers;
}

}  // namespace dhpmap::postgres
