// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace dhpmap {

/// A text table. Each cell is made Printable; numbers are right-aligned, other text left.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) : rows_{std::move(header)} {}
  void Add(std::vector<std::string> row);
  void Print(std::ostream& out) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// With this number of decimals.
std::string Fixed(double value, int decimals);
/// "12.3 MiB".
std::string Bytes(double bytes);
/// The name of an enumerator in lower case.
std::string Lower(std::string text);

}  // namespace dhpmap
