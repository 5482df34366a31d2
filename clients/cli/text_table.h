// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace dhpmap {

/// Columns of text for people, each cell made Printable, aligned: numbers to the right, the rest to the left.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) : rows_{std::move(header)} {}
  void Add(std::vector<std::string> row);
  void Print(std::ostream& out) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// With so many decimals.
std::string Fixed(double value, int decimals);
/// "12.3 MiB".
std::string Bytes(double bytes);
/// The name of an enumerator, as people read it.
std::string Lower(std::string text);

}  // namespace dhpmap
