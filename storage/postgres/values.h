// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/codec/bytes.h"
#include "storage/rows/parameters.h"

namespace dhpmap::postgres {

/// The parameters of a statement, in order, in PostgreSQL's binary form. Copies all values.
class Values final : public Parameters {
 public:
  template <std::integral Int>
  Values& Add(Int value) {
    PutInt(static_cast<std::int64_t>(value));
    return *this;
  }
  Values& Add(std::string_view text) {
    PutText(text);
    return *this;
  }
  Values& Add(ByteView bytes) {
    PutCopy(bytes);
    return *this;
  }
  /// bigint[].
  Values& Add(std::span<const std::int64_t> numbers);

  void PutInt(std::int64_t value) override;
  void PutReal(double value) override;
  void PutText(std::string_view text) override;
  void PutCopy(std::span<const std::uint8_t> bytes) override;

  [[nodiscard]] std::size_t size() const { return places_.size(); }
  [[nodiscard]] std::size_t num_bytes() const { return bytes_.size(); }
  /// For libpq: types, lengths, and pointers that are valid until the next Add.
  [[nodiscard]] std::vector<unsigned> Types() const;
  [[nodiscard]] std::vector<int> Lengths() const;
  [[nodiscard]] std::vector<const char*> Pointers() const;

 private:
  struct Place {
    unsigned type = 0;
    std::size_t first = 0;
    int length = 0;
  };
  void Begin(unsigned type);
  void End();
  void Append(std::uint64_t value, int num_bytes);

  std::string bytes_;
  std::vector<Place> places_;
};

/// A statement with its parameters. The text must outlive it: it names the prepared statement.
struct Call {
  const std::string* sql = nullptr;
  Values values = {};
};

}  // namespace dhpmap::postgres
