// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/e2e/process.h"
#include "tests/support/fake_manager.h"
#include "tests/support/places.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {

/// A server as a service manager starts it.
class ServiceTest : public ::testing::Test {
 protected:
  using Variables = std::vector<std::pair<std::string, std::string>>;

  [[nodiscard]] std::filesystem::path File(const std::string& name) const { return folder_.path() / name; }
  void Write(const std::string& name, const std::string& text) const { std::ofstream(File(name)) << text; }

  [[nodiscard]] std::vector<std::string> Command(const std::vector<std::string>& more) const {
    std::vector<std::string> command = {Program("dhpmap-server"), "--db", File("maps.db").string()};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  /// On free ports, with NOTIFY_SOCKET and these variables.
  void Start(std::vector<std::string> more = {}, Variables variables = {}) {
    ASSERT_TRUE(manager_.is_open());
    more.insert(more.end(), {"--grpc", "127.0.0.1:0", "--http", "127.0.0.1:0"});
    variables.emplace_back("NOTIFY_SOCKET", manager_.name());
    for (const auto& [name, value] : variables) setenv(name.c_str(), value.c_str(), 1);
    server_ = std::make_unique<Process>(folder_.path(), Command(more));
    for (const auto& variable : variables) unsetenv(variable.first.c_str());
  }
  /// Of "READY=1\nSTATUS=gRPC on 127.0.0.1:1, REST on http://127.0.0.1:2".
  static std::string RestUrlIn(const std::string& ready) {
    std::smatch match;
    return std::regex_search(ready, match, std::regex("REST on (\\S+)")) ? match[1].str() : "";
  }
  [[nodiscard]] Outcome Curl(const std::string& url) const {
    return RunProgram(folder_.path(), {"curl", "-s", "-i", url});
  }
  void EndServer() {
    server_->Signal(SIGTERM);
    EXPECT_EQ(server_->Wait(), 0) << server_->Stderr();
  }

  TempDir folder_;
  FakeManager manager_{(folder_.path() / "notify").string()};
  std::unique_ptr<Process> server_;
};

}  // namespace dhpmap::testing
