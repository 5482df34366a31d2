// SPDX-License-Identifier: BSD-3-Clause
// The C++ client at a real server that wants TLS and keys.
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <string>

#include "dhpmap/client.h"
#include "tests/e2e/process.h"
#include "tests/support/assert_ok.h"
#include "tests/support/scenes.h"
#include "tests/unit/clients/cpp/certificates.h"

namespace dhpmap::testing {
namespace {

/// Of this machine, with TLS, and keys for "anna", who may do everything, and "vera", who may look.
class ClientKeys : public ::testing::Test {
 protected:
  void SetUp() override {
    Write("server.crt", kOwnCertificate);
    Write("server.key", kOwnKey);
    CreateKey("anna", "admin");
    CreateKey("vera", "viewer");
    server_ = std::make_unique<Process>(
        dir_.path(),
        std::vector<std::string>{Program("dhpmap-server"), "--db", File("maps.db"), "--grpc", "127.0.0.1:0", "--http",
                                 "127.0.0.1:0", "--set", "tls.cert=" + File("server.crt"), "--set",
                                 "tls.key=" + File("server.key")});
    const std::regex told("gRPC on ([^ ,]+)");
    ASSERT_TRUE(Eventually([&] {
      const std::string out = server_->Stdout();
      std::smatch match;
      if (std::regex_search(out, match, told)) address_ = match[1];
      return !address_.empty() || server_->Wait(0).has_value();
    }));
    ASSERT_FALSE(address_.empty()) << server_->Stdout() << server_->Stderr();
  }
  [[nodiscard]] std::string File(const std::string& name) const { return (dir_.path() / name).string(); }
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(File(name)) << text;
    std::filesystem::permissions(File(name), std::filesystem::perms::owner_read);
  }
  void CreateKey(const std::string& name, const std::string& role) const {
    const Outcome made = RunProgram(
        dir_.path(), {Program("dhpmap"), "keys", "create", name, "--role", role, "--keys", File("maps.db.keys")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    Write(name + ".key", made.out);
  }
  [[nodiscard]] client::Result<client::Client> ConnectAs(const std::string& name) const {
    return client::Client::Connect(address_, {.ca_file = File("server.crt"), .token_file = File(name + ".key")});
  }

  TempDir dir_;
  std::unique_ptr<Process> server_;
  std::string address_;
};

TEST_F(ClientKeys, AKeyDoesWhatItsRoleMay) {
  const auto anna = ConnectAs("anna"), vera = ConnectAs("vera");
  ASSERT_OK(anna);
  ASSERT_OK(vera);
  ASSERT_OK(anna->CreateMap("office"));
  ASSERT_OK_AND_ASSIGN(const client::Map office, vera->OpenMap("office"));
  EXPECT_EQ(vera->DeleteMap("office").code, client::StatusCode::kPermissionDenied);
  EXPECT_EQ(office.Feed({.session = "vera"}).status().code, client::StatusCode::kPermissionDenied);
  client::Watch watch = office.Watch();
  ASSERT_OK(watch.Next(0));
  client::Loop loop = office.Loop();
  ASSERT_OK(loop.Pin());
  ASSERT_OK(anna->DeleteMap("office"));
}

TEST_F(ClientKeys, WhoShowsNoneIsToldSoAtOnce) {
  const auto nobody = client::Client::Connect(address_, {.ca_file = File("server.crt")});
  ASSERT_OK(nobody);
  EXPECT_EQ(nobody->Maps().status().code, client::StatusCode::kUnauthenticated);
  EXPECT_EQ(nobody->OpenMap("office").status().code, client::StatusCode::kUnauthenticated);
}

}  // namespace
}  // namespace dhpmap::testing
