// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

#include "tests/e2e/rendered_dataset.h"
#include "tests/e2e/server_process.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

/// Paths of the libraries that a process has in memory.
std::set<std::string> LibrariesOf(pid_t pid) {
  std::set<std::string> libraries;
  std::ifstream maps("/proc/" + std::to_string(pid) + "/maps");
  for (std::string line; std::getline(maps, line);) {
    const auto path = line.find('/');
    if (path != std::string::npos && line.find(".so", path) != std::string::npos) libraries.insert(line.substr(path));
  }
  return libraries;
}

bool Has(const std::set<std::string>& libraries, const std::string& name) {
  for (const std::string& library : libraries) {
    if (library.find(name) != std::string::npos) return true;
  }
  return false;
}

TEST(Libraries, AServerThatHasReadImagesHasNoneOfOpenCvAndPcl) {
  const TempDir folder;
  WriteRenderedDataset(folder.path() / "dataset", 1);  // PNG and TIFF
  ServerProcess server(folder.path(), folder.path() / "maps.db");
  ASSERT_TRUE(server.is_serving());
  const Outcome mapped = server.Dhpmap({"map", (folder.path() / "dataset").string(), "--map", "room"});
  ASSERT_EQ(mapped.exit_code, 0) << mapped.err;
  const auto libraries = LibrariesOf(server.process().pid());
  EXPECT_TRUE(Has(libraries, "libgrpc")) << "the test sees libraries at all";
  for (const char* name : {"opencv", "pcl", "gdal", "vtk"}) EXPECT_FALSE(Has(libraries, name)) << name;
  EXPECT_LT(libraries.size(), 100u);
}

}  // namespace
}  // namespace dhpmap::testing
