// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace dhpmap {

/// Where a row's values go: the parameters of a statement of some database, in order.
class Parameters {
 public:
  virtual void PutInt(std::int64_t value) = 0;
  virtual void PutReal(double value) = 0;
  /// The text must live until the statement has run.
  virtual void PutText(std::string_view text) = 0;
  /// The bytes need not outlive the call.
  virtual void PutCopy(std::span<const std::uint8_t> bytes) = 0;

 protected:
  ~Parameters() = default;
};

/// Where a row's values come from: the columns of a row of some database, in order. Views are valid until the next row.
class RowColumns {
 public:
  virtual std::int64_t Int() = 0;
  virtual double Real() = 0;
  virtual std::string Text() = 0;
  virtual std::span<const std::uint8_t> Blob() = 0;

 protected:
  ~RowColumns() = default;
};

}  // namespace dhpmap
