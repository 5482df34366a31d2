// SPDX-License-Identifier: BSD-3-Clause
// What a server takes of the machine, and gives back.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/e2e/rendered_dataset.h"
#include "tests/e2e/server_process.h"
#include "tests/support/eventually.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

constexpr double kMiB = 1 << 20;

/// A gauge without labels as /metrics has it.
double Gauge(const std::filesystem::path& directory, const ServerProcess& server, const std::string& name) {
  const Outcome page = RunProgram(directory, {"curl", "--silent", "--fail", server.http_url() + "/metrics"});
  EXPECT_EQ(page.exit_code, 0) << page.err;
  const std::size_t at = page.out.find("\n" + name + " ");
  EXPECT_NE(at, std::string::npos) << name << " is not in\n" << page.out;
  return at == std::string::npos ? 0 : std::stod(page.out.substr(at + name.size() + 2));
}

TEST(Memory, ComesBackWhenMapsAreDeleted) {
  const TempDir temp;
  const std::filesystem::path& root = temp.path();
  WriteRenderedDataset(root / "dataset", 12);
  ServerProcess server(root, root / "maps.db");
  ASSERT_TRUE(server.is_serving());
  // Of a server that has mapped once: threads and connections are there, which one that has just started lacks.
  ASSERT_EQ(server.Dhpmap({"map", (root / "dataset").string(), "--map", "first"}).exit_code, 0);
  const double live_with_first = Gauge(root, server, "dhpmap_heap_live_bytes");
  ASSERT_EQ(server.Dhpmap({"maps", "delete", "first", "--yes"}).exit_code, 0);
  ASSERT_TRUE(Eventually([&] {  // the allocator gives pages back a moment after they were last used
    const double live = Gauge(root, server, "dhpmap_heap_live_bytes");
    const double kept = Gauge(root, server, "dhpmap_heap_resident_bytes") - live;
    return live < live_with_first / 2 && kept < 8 * kMiB;
  }));
  const double before = Gauge(root, server, "dhpmap_anonymous_memory_bytes");
  constexpr double kStays = 20 * kMiB;
  double most = 0;
  for (int i = 0; i < 4; ++i) {
    const std::string map = "m" + std::to_string(i);
    const Outcome mapped = server.Dhpmap({"map", (root / "dataset").string(), "--map", map});
    ASSERT_EQ(mapped.exit_code, 0) << mapped.err;
    most = std::max(most, Gauge(root, server, "dhpmap_anonymous_memory_bytes"));
  }
  const double live = Gauge(root, server, "dhpmap_heap_live_bytes");
  EXPECT_GT(live, most / 4) << "what maps take is handed out";
  EXPECT_LT(live, Gauge(root, server, "dhpmap_heap_resident_bytes"));
  for (int i = 0; i < 4; ++i)
    ASSERT_EQ(server.Dhpmap({"maps", "delete", "m" + std::to_string(i), "--yes"}).exit_code, 0);
  EXPECT_GT(most, before + 1.2 * kStays) << "too small maps to tell anything";
  double after = 0;
  Eventually([&] {
    after = Gauge(root, server, "dhpmap_anonymous_memory_bytes");
    return after <= before + kStays;
  });
  EXPECT_LE(after, before + kStays) << "at most " << most / kMiB << " MiB while mapped, " << before / kMiB << " before";
}

}  // namespace
}  // namespace dhpmap::testing
