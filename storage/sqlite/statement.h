// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "mapping/base/result.h"
#include "storage/rows/parameters.h"

struct sqlite3_stmt;

namespace dhpmap::sqlite {

class Columns;

/// A prepared statement. Bind its parameters in order, then Run it, or Step through its rows; afterwards it is reset.
/// The next Step reports binding errors. Must not outlive its Database. Thread-compatible, together with the Database.
class Statement final : public Parameters {
 public:
  using RowReader = Columns;

  /// Takes over `statement`. `task` completes "cannot ..." in error messages; a literal.
  Statement(sqlite3_stmt* statement, const char* task);

  /// Text and bytes are not copied: they must live until the statement has run.
  template <std::integral Int>
  Statement& Bind(Int value) {
    return BindInt(static_cast<std::int64_t>(value));
  }
  Statement& Bind(double value);
  Statement& Bind(std::string_view text);
  Statement& Bind(std::span<const std::uint8_t> bytes);
  /// For bytes that need not outlive the call.
  Statement& BindCopy(std::span<const std::uint8_t> bytes);

  void PutInt(std::int64_t value) override { BindInt(value); }
  void PutReal(double value) override { Bind(value); }
  void PutText(std::string_view text) override { Bind(text); }
  void PutCopy(std::span<const std::uint8_t> bytes) override { BindCopy(bytes); }

  /// True: there is a row to read. False: done.
  Result<bool> Step();
  /// Steps to the end and ignores rows.
  Status Run();
  /// Ends stepping before the last row. Parameters must be bound again.
  void Reset();

  // Columns of the row, from 0. Views are valid until the next Step, Run or Reset.
  [[nodiscard]] std::int64_t Int(int column) const;
  [[nodiscard]] double Real(int column) const;
  [[nodiscard]] std::string Text(int column) const;
  [[nodiscard]] std::span<const std::uint8_t> Blob(int column) const;

 private:
  struct Finalizer {
    void operator()(sqlite3_stmt* statement) const;
  };
  Statement& BindInt(std::int64_t value);
  void Note(int code);

  std::unique_ptr<sqlite3_stmt, Finalizer> statement_;
  const char* task_;
  int next_parameter_ = 1;
  int bind_error_ = 0;
};

/// Reads the columns of the present row in order, as Bind binds parameters. Views are valid until the statement's next
/// Step, Run or Reset.
class Columns final : public RowColumns {
 public:
  explicit Columns(const Statement& statement) : statement_(statement) {}

  std::int64_t Int() override { return statement_.Int(next_++); }
  double Real() override { return statement_.Real(next_++); }
  std::string Text() override { return statement_.Text(next_++); }
  std::span<const std::uint8_t> Blob() override { return statement_.Blob(next_++); }

 private:
  const Statement& statement_;
  int next_ = 0;
};

}  // namespace dhpmap::sqlite
