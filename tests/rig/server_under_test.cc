// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/server_under_test.h"

#include <cstdio>
#include <cstdlib>

namespace dhpmap::rig {

ServerUnderTest::ServerUnderTest(const std::map<std::string, std::string>& settings) {
  for (const auto& [name, value] : settings) setenv(name.c_str(), value.c_str(), 1);
  server_ = std::make_unique<testing::ServerProcess>(folder_, folder_ / "maps.db");
  if (server_->is_serving()) return;
  std::fprintf(stderr, "the server does not start: %s\n", server_->process().Stderr().c_str());
  std::exit(1);
}

int ServerUnderTest::http_port() const {
  const std::string& url = server_->http_url();
  return std::stoi(url.substr(url.rfind(':') + 1));
}

Target ServerUnderTest::TargetOf(const std::string& map_id) const {
  return {.grpc_address = server_->grpc_address(), .http_port = http_port(), .map_id = map_id};
}

double ServerUnderTest::Metric(const std::string& name) const { return rig::Metric(MetricsOf(http_port()), name); }

double ServerUnderTest::MapsMib() const {
  const std::string metrics = MetricsOf(http_port());
  return (rig::Metric(metrics, "dhpmap_map_memory_bytes") + rig::Metric(metrics, "dhpmap_past_states_memory_bytes")) /
         (1 << 20);
}

bool ServerUnderTest::MapDataset(const std::string& dataset, const std::string& map_id,
                                 const std::vector<std::string>& options) {
  std::vector<std::string> arguments = {"map", dataset, "--map", map_id};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const testing::Outcome mapped = server_->Dhpmap(arguments);
  if (mapped.exit_code != 0) std::printf("FAILED: mapping %s: %s\n", dataset.c_str(), mapped.err.c_str());
  return mapped.exit_code == 0;
}

std::unique_ptr<testing::Process> StartSelf(const std::filesystem::path& folder, std::vector<std::string> arguments,
                                            int niceness) {
  std::vector<std::string> command = {"nice", "-n", std::to_string(niceness), testing::Program("dhpmap-rig")};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return std::make_unique<testing::Process>(folder, std::move(command));
}

bool Expect(const std::string& what, double seen, double limit, const std::string& unit) {
  const bool held = seen <= limit;
  std::printf("%s %s: %.1f %s, limit %.1f\n", held ? "ok:    " : "FAILED:", what.c_str(), seen, unit.c_str(), limit);
  std::fflush(stdout);
  return held;
}

}  // namespace dhpmap::rig
