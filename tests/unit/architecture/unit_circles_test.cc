// SPDX-License-Identifier: BSD-3-Clause
// A unit is a header and its source. Who reads one must not have to read a circle of them, in a room or across rooms.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

/// Of each unit, by its path without extension, those that its header or source includes.
using Units = std::map<std::string, std::set<std::string>>;

std::string UnitOf(const fs::path& file) { return fs::path(file).replace_extension().string(); }

Units ReadUnits(const fs::path& root) {
  static const std::regex pattern(R"(^\s*#\s*include\s*"([^"]+)\")");
  Units units;
  for (const char* top : {"mapping", "storage", "proto", "server", "clients", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cc") continue;
      const std::string unit = UnitOf(fs::relative(entry.path(), root));
      std::set<std::string>& included = units[unit];
      std::ifstream in(entry.path());
      std::smatch match;
      for (std::string line; std::getline(in, line);) {
        if (!std::regex_search(line, match, pattern)) continue;
        const fs::path path = match[1].str();
        if (fs::exists(root / path) && UnitOf(path) != unit) included.insert(UnitOf(path));
      }
    }
  }
  return units;
}

/// Tarjan's strongly connected components: those of more than one unit.
class CircleFinder {
 public:
  explicit CircleFinder(const Units& units) : units_(units) {
    for (const auto& [unit, included] : units_) {
      if (!number_.contains(unit)) Visit(unit);
    }
  }
  [[nodiscard]] const std::vector<std::vector<std::string>>& circles() const { return circles_; }

 private:
  void Visit(const std::string& unit) {
    const std::size_t number = number_.size();
    number_[unit] = lowest_[unit] = number;
    open_.push_back(unit);
    const auto found = units_.find(unit);
    for (const std::string& next : found != units_.end() ? found->second : std::set<std::string>()) {
      if (!number_.contains(next)) Visit(next);
      if (std::find(open_.begin(), open_.end(), next) != open_.end()) {
        lowest_[unit] = std::min(lowest_[unit], lowest_[next]);
      }
    }
    if (lowest_[unit] != number) return;
    const auto first = std::find(open_.begin(), open_.end(), unit);
    if (open_.end() - first > 1) circles_.emplace_back(first, open_.end());
    open_.erase(first, open_.end());
  }

  const Units& units_;
  std::map<std::string, std::size_t> number_, lowest_;
  std::vector<std::string> open_;
  std::vector<std::vector<std::string>> circles_;
};

TEST(Architecture, UnitsFormNoCircle) {
  const Units units = ReadUnits(testing::SourceDir());
  ASSERT_GT(units.size(), 500u);
  const CircleFinder finder(units);
  for (const std::vector<std::string>& circle : finder.circles()) {
    std::string names;
    for (const std::string& unit : circle) names += "\n  " + unit;
    ADD_FAILURE() << "these units include each other in a circle:" << names;
  }
}

TEST(Architecture, ACircleOfUnitsIsFound) {
  const Units units = {{"a", {"b"}}, {"b", {"c", "d"}}, {"c", {"a"}}, {"d", {}}, {"e", {"d", "a"}}};
  const CircleFinder finder(units);
  const auto& circles = finder.circles();
  ASSERT_EQ(circles.size(), 1u);
  EXPECT_EQ(std::set<std::string>(circles[0].begin(), circles[0].end()), (std::set<std::string>{"a", "b", "c"}));
}

}  // namespace
}  // namespace dhpmap
