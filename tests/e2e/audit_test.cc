// SPDX-License-Identifier: BSD-3-Clause
// The audit log of a real server, and what logrotate does to it.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <regex>
#include <string>

#include "tests/e2e/process.h"
#include "tests/support/eventually.h"
#include "tests/support/scenes.h"
#include "tests/unit/server/http/http_client.h"

namespace dhpmap::testing {
namespace {

namespace fs = std::filesystem;

class AuditedServer : public ::testing::Test {
 protected:
  AuditedServer() {
    const std::string db = Path("maps.db");
    const Outcome made = RunProgram(
        folder_.path(), {Program("dhpmap"), "keys", "create", "anna", "--role", "admin", "--keys", db + ".keys"});
    key_ = made.out.substr(0, made.out.find('\n'));
    server_ = std::make_unique<Process>(
        folder_.path(),
        std::vector<std::string>{Program("dhpmap-server"), "--db", db, "--grpc", "127.0.0.1:0", "--http", "127.0.0.1:0",
                                 "--set", "auth.audit=" + Path("audit.jsonl"), "--set", "auth.audit_required=true"});
    const std::regex line("REST on http://127.0.0.1:([0-9]+)\n");
    std::smatch match;
    EXPECT_TRUE(Eventually([&] {
      const std::string text = server_->Stdout();
      if (std::regex_search(text, match, line)) port_ = std::stoi(match[1]);
      return port_ != 0 || server_->Wait(0).has_value();
    }));
    EXPECT_NE(port_, 0) << server_->Stderr();
  }
  [[nodiscard]] std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }
  [[nodiscard]] std::string Text(const std::string& name) const {
    std::ifstream file(Path(name));
    return {std::istreambuf_iterator<char>(file), {}};
  }
  [[nodiscard]] int Create(const std::string& map) const {
    http::HttpClient client(port_);
    return client.Ask("POST", "/v1/maps", R"({"mapId": ")" + map + "\"}", {{"Authorization", "Bearer " + key_}}).status;
  }

  TempDir folder_;
  std::string key_;
  std::unique_ptr<Process> server_;
  int port_ = 0;
};

TEST_F(AuditedServer, GoesOnInANewFileAtSighup) {
  EXPECT_EQ(Create("before"), 200);
  fs::rename(Path("audit.jsonl"), Path("audit.jsonl.1"));
  EXPECT_EQ(Create("between"), 200);
  server_->Signal(SIGHUP);
  EXPECT_TRUE(Eventually([&] { return fs::exists(Path("audit.jsonl")); })) << server_->Stderr();
  EXPECT_EQ(Create("after"), 200) << "it goes on";
  const std::string old = Text("audit.jsonl.1"), now = Text("audit.jsonl");
  EXPECT_NE(old.find("\"map\":\"before\""), std::string::npos) << old;
  EXPECT_NE(old.find("\"map\":\"between\""), std::string::npos) << old;
  EXPECT_EQ(old.find("\"map\":\"after\""), std::string::npos);
  EXPECT_NE(now.find("\"map\":\"after\""), std::string::npos) << now;
  EXPECT_EQ((old + now).find(key_), std::string::npos);
  EXPECT_TRUE(fs::exists(Path("maps.db.owners")));
  server_->Signal(SIGTERM);
  EXPECT_EQ(server_->Wait(), 0) << server_->Stderr();
}

}  // namespace
}  // namespace dhpmap::testing
