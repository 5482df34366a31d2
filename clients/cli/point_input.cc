// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/point_input.h"

#include <algorithm>
#include <charconv>
#include <sstream>

namespace dhpmap {

Result<std::vector<float>> ReadPoints(std::istream& in) {
  std::vector<float> xyz_m;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    line.resize(std::min(line.find('#'), line.size()));
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      float value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size()) {
        return InvalidArgument("line " + std::to_string(number) + ": '" + word + "' is not a number");
      }
      xyz_m.push_back(value);
    }
  }
  if (xyz_m.empty()) return InvalidArgument("there are no points");
  if (xyz_m.size() % 3 != 0) {
    return InvalidArgument(std::to_string(xyz_m.size()) + " numbers are not a whole number of points");
  }
  return xyz_m;
}

}  // namespace dhpmap
