// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "storage/rows/parameters.h"

struct pg_result;

namespace dhpmap::postgres {

/// The rows of a statement's result, in binary form. `while (answer.Next()) answer.Int()...` reads the columns of each
/// row in order. Views stay valid while the answer lives. Move-only; thread-compatible.
class Answer final : public RowColumns {
 public:
  /// Takes over `result`; null: no rows.
  explicit Answer(pg_result* result = nullptr) : result_(result) {}

  /// Goes to the next row; false: there is none.
  bool Next();
  [[nodiscard]] int num_rows() const;
  [[nodiscard]] const pg_result* result() const { return result_.get(); }
  /// Number of rows that an INSERT, UPDATE or DELETE wrote.
  [[nodiscard]] std::int64_t NumChanged() const;
  /// The server's command tag, such as "COMMIT".
  [[nodiscard]] std::string Tag() const;

  /// Reads a smallint, integer, bigint or boolean.
  std::int64_t Int() override;
  double Real() override;
  std::string Text() override;
  std::span<const std::uint8_t> Blob() override;

 private:
  struct Clearer {
    void operator()(pg_result* result) const;
  };
  std::unique_ptr<pg_result, Clearer> result_;
  int row_ = -1;
  int column_ = 0;
};

}  // namespace dhpmap::postgres
