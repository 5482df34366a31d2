// SPDX-License-Identifier: BSD-3-Clause
// There is one version number: the one in CMakeLists.txt, which the programs report and which is to be tagged.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace dhpmap {
namespace {

std::string TextOf(const std::string& file) {
  std::ifstream in(std::filesystem::path(testing::SourceDir()) / file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Version, TheNewestInTheChangelogIsTheOneThatIsBuilt) {
  const std::string cmake = TextOf("CMakeLists.txt"), changelog = TextOf("CHANGELOG.md");
  std::smatch built;
  ASSERT_TRUE(std::regex_search(cmake, built, std::regex(R"(project\(dhpmap VERSION ([0-9]+\.[0-9]+\.[0-9]+) )")));

  std::vector<std::string> headings;
  const std::regex heading(R"(## \[([^\]]+)\]( - [0-9]{4}-[0-9]{2}-[0-9]{2})?\n)");
  for (std::sregex_iterator it(changelog.begin(), changelog.end(), heading), end; it != end; ++it) {
    headings.push_back((*it)[1]);
    EXPECT_EQ((*it)[2].matched, headings.size() > 1) << "a version has a date, what is not released has none";
  }
  ASSERT_GE(headings.size(), 2u);
  EXPECT_EQ(headings[0], "Unreleased");
  EXPECT_EQ(headings[1], built[1]);
  EXPECT_NE(TextOf("clients/python/dhpmap/__init__.py").find("__version__ = \"" + built[1].str() + '"'),
            std::string::npos);
}

}  // namespace
}  // namespace dhpmap
