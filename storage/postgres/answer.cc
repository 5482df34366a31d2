// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/answer.h"

#include <libpq-fe.h>

#include <bit>
#include <cstdlib>

namespace dhpmap::postgres {

void Answer::Clearer::operator()(pg_result* result) const { PQclear(result); }

int Answer::num_rows() const { return result_ == nullptr ? 0 : PQntuples(result_.get()); }

bool Answer::Next() {
  column_ = 0;
  return ++row_ < num_rows();
}

std::int64_t Answer::NumChanged() const {
  return result_ == nullptr ? 0 : std::strtoll(PQcmdTuples(result_.get()), nullptr, 10);
}

std::string Answer::Tag() const { return result_ == nullptr ? "" : PQcmdStatus(result_.get()); }

std::span<const std::uint8_t> Answer::Blob() {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(PQgetvalue(result_.get(), row_, column_));
  const auto size = static_cast<std::size_t>(PQgetlength(result_.get(), row_, column_));
  ++column_;
  return {bytes, size};
}

std::int64_t Answer::Int() {
  const auto bytes = Blob();
  if (bytes.empty()) return 0;  // null
  std::uint64_t value = bytes.size() > 1 && bytes[0] >= 0x80 ? ~std::uint64_t{0} : 0;
  for (const std::uint8_t byte : bytes) value = value << 8 | byte;
  return static_cast<std::int64_t>(value);
}

double Answer::Real() { return std::bit_cast<double>(Int()); }

std::string Answer::Text() {
  const auto bytes = Blob();
  return {bytes.begin(), bytes.end()};
}

}  // namespace dhpmap::postgres
