// SPDX-License-Identifier: BSD-3-Clause
// The base of test stores passes on every call: one that MapStore gets later must not end in its default.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "tests/support/places.h"

namespace dhpmap {
namespace {

std::string TextOfHeader(const std::string& file) {
  std::ifstream in(std::filesystem::path(testing::SourceDir()) / file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(WrappedStore, PassesOnEveryCallOfAMapStore) {
  const std::string header = TextOfHeader("storage/store.h"), wrapped = TextOfHeader("tests/support/wrapped_store.h");
  const std::string store = header.substr(header.find("class MapStore {"));
  const std::regex declaration(R"(virtual [^;{=~]*?\b([A-Za-z]+)\([^;{]*)");
  int num_calls = 0;
  for (std::sregex_iterator it(store.begin(), store.end(), declaration), end; it != end; ++it) {
    const std::string name = (*it)[1];
    EXPECT_NE(wrapped.find("inner_." + name + "("), std::string::npos) << name;
    ++num_calls;
  }
  EXPECT_GE(num_calls, 20);
}

}  // namespace
}  // namespace dhpmap
