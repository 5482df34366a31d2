// SPDX-License-Identifier: BSD-3-Clause
// clients/datasets/FLAT.md: who has read nothing else writes a folder that maps as it should.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "tests/e2e/server_process.h"
#include "tests/support/places.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

constexpr char kPython[] = "/usr/bin/python3";

/// What stands between ```python and ```.
std::string ScriptOf(const std::filesystem::path& document) {
  std::ifstream in(document);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string begin = "\n```python\n";
  const std::size_t from = text.find(begin);
  if (from == std::string::npos) return {};
  return text.substr(from + begin.size(), text.find("\n```\n", from) - from - begin.size());
}

TEST(FlatLayout, TheDocumentsExampleMapsAsItSays) {
  ASSERT_TRUE(std::filesystem::exists(kPython)) << "deploy/setup.sh installs it";
  const TempDir temp;
  const std::string script = (temp.path() / "write.py").string(), folder = (temp.path() / "crate_room").string();
  std::ofstream(script) << ScriptOf(SourceDir() / "clients/datasets/FLAT.md") << "\n";
  const Outcome written = RunProgram(temp.path(), {kPython, script, folder});
  ASSERT_EQ(written.exit_code, 0) << written.err;

  ServerProcess server(temp.path(), temp.path() / "maps.db");
  ASSERT_TRUE(server.is_serving()) << server.process().Stderr();
  const Outcome mapped = server.Dhpmap({"map", folder, "--map", "crate"});
  ASSERT_EQ(mapped.exit_code, 0) << mapped.out << mapped.err;
  const auto at = [&server](const char* x, const char* y, const char* z) {
    return server.Dhpmap({"query", "point", "crate", x, y, z, "--json"}).out;
  };
  const auto names = [](const std::string& answer, const std::string& name) {
    return answer.find("\"class_name\": \"" + name + "\"") != std::string::npos;
  };
  EXPECT_TRUE(names(at("2.0", "0", "0.3"), "crate")) << "its front: " << at("2.0", "0", "0.3");
  EXPECT_TRUE(names(at("2.3", "0", "0.6"), "crate")) << "its top: " << at("2.3", "0", "0.6");
  EXPECT_TRUE(names(at("1.5", "-0.5", "0"), "floor")) << at("1.5", "-0.5", "0");
  EXPECT_TRUE(names(at("3.0", "0.5", "1.2"), "wall")) << at("3.0", "0.5", "1.2");
  EXPECT_NE(at("1.0", "0", "0.8").find("\"free\": true"), std::string::npos) << at("1.0", "0", "0.8");
}

}  // namespace
}  // namespace dhpmap::testing
