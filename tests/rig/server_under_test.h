// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/e2e/server_process.h"
#include "tests/rig/load/bulk_calls.h"
#include "tests/rig/server_watch.h"
#include "tests/support/scenes.h"

namespace dhpmap::rig {

/// A server in a temporary folder, and what a rig says about it.
class ServerUnderTest {
 public:
  /// `settings` as environment variables: {"DHPMAP_MAPS_IDLE_CLOSE_S", "5"}. Ends the program if it does not start.
  explicit ServerUnderTest(const std::map<std::string, std::string>& settings = {});

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] testing::ServerProcess& process() { return *server_; }
  [[nodiscard]] pid_t pid() { return server_->process().pid(); }
  [[nodiscard]] int http_port() const;
  [[nodiscard]] Target TargetOf(const std::string& map_id) const;
  [[nodiscard]] double Metric(const std::string& name) const;
  /// What maps take: their present states, and the past ones that history.kept_states_mib keeps, MiB.
  [[nodiscard]] double MapsMib() const;
  /// `dhpmap map`: false, and said, if that failed.
  bool MapDataset(const std::string& dataset, const std::string& map_id, const std::vector<std::string>& options = {});

 private:
  testing::TempDir temp_;
  std::filesystem::path folder_ = temp_.path();
  std::unique_ptr<testing::ServerProcess> server_;
};

/// This program again, in another process, with `arguments`.
std::unique_ptr<testing::Process> StartSelf(const std::filesystem::path& folder, std::vector<std::string> arguments,
                                            int niceness = 0);

/// Prints a line with what was seen and the limit; whether it is within.
bool Expect(const std::string& what, double seen, double limit, const std::string& unit);

}  // namespace dhpmap::rig
