// SPDX-License-Identifier: BSD-3-Clause
// Sockets that a service manager opens: by systemd's own program for it, where that is installed.
#include <csignal>

#include "tests/e2e/server_process.h"
#include "tests/e2e/service/service_fixture.h"
#include "tests/support/eventually.h"
#include "tests/unit/server/net/test_certificates.h"

namespace dhpmap::testing {
namespace {

class Activation : public ServiceTest {
 protected:
  void SetUp() override {
    if (RunProgram(folder_.path(), {"systemd-socket-activate", "--version"}).exit_code != 0) {
      GTEST_SKIP() << "systemd-socket-activate is not installed (Debian's package systemd has it)";
    }
  }
  /// It starts the server with the first connection.
  void StartActivated(const std::vector<std::string>& sockets, const std::string& names,
                      const std::vector<std::string>& more = {}) {
    std::vector<std::string> command = {"systemd-socket-activate", "--fdname=" + names};
    for (const std::string& socket : sockets) command.insert(command.end(), {"-l", socket});
    const std::vector<std::string> server = Command(more);
    command.insert(command.end(), server.begin(), server.end());
    server_ = std::make_unique<Process>(folder_.path(), command);
    ASSERT_TRUE(Eventually([&] { return server_->Stderr().find("Listening on") != std::string::npos; }))
        << server_->Stderr();
  }
  [[nodiscard]] Outcome Maps(std::vector<std::string> command) const {
    command.insert(command.begin(), Program("dhpmap"));
    command.emplace_back("maps");
    return RunProgram(folder_.path(), std::move(command));
  }
};

TEST_F(Activation, TheFirstConnectionIsAnsweredThroughBothDoors) {
  const std::string grpc = AddressToComeBackTo(), rest = File("rest").string();
  StartActivated({grpc, rest}, "grpc:rest");
  const Outcome listed = Maps({"--server", grpc});
  EXPECT_EQ(listed.exit_code, 0) << listed.err << server_->Stderr();
  const Outcome asked = RunProgram(folder_.path(), {"curl", "-s", "--unix-socket", rest, "http://localhost/readyz"});
  EXPECT_EQ(asked.out, "ready\n") << asked.err;
  EXPECT_NE(server_->Stdout().find("gRPC on " + grpc + ", REST on http://unix:" + rest), std::string::npos)
      << server_->Stdout();
  EndServer();
  EXPECT_TRUE(std::filesystem::exists(rest)) << "the file is the manager's";
}

TEST_F(Activation, ADoorWithoutASocketOpensItsAddress) {
  const std::string rest = AddressToComeBackTo();
  StartActivated({rest}, "rest", {"--grpc", "unix:" + File("grpc").string()});
  EXPECT_NE(Curl("http://" + rest + "/readyz").out.find("200"), std::string::npos) << server_->Stderr();
  EXPECT_EQ(Maps({"--server", "unix:" + File("grpc").string()}).exit_code, 0);
  EndServer();
}

TEST_F(Activation, ASocketThatOtherMachinesReachNeedsTlsAndKeys) {
  const std::string local = AddressToComeBackTo(), port = local.substr(local.rfind(':'));
  StartActivated({"0.0.0.0" + port}, "rest");
  (void)Curl("http://" + local + "/readyz");
  EXPECT_EQ(server_->Wait(), 2);
  EXPECT_NE(server_->Stderr().find("'0.0.0.0" + port + "' can be reached from other machines"), std::string::npos)
      << server_->Stderr();
}

TEST_F(Activation, OverTls) {
  const CertificateFiles own = MakeCertificate(folder_.path(), "own");
  const std::string grpc = AddressToComeBackTo(), rest = File("rest").string();
  StartActivated({grpc, rest}, "grpc:rest", {"--set", "tls.cert=" + own.cert, "--set", "tls.key=" + own.key});
  const Outcome listed = Maps({"--server", "localhost" + grpc.substr(grpc.rfind(':')), "--ca", own.cert});
  EXPECT_EQ(listed.exit_code, 0) << listed.err << server_->Stderr();
  EndServer();
}

TEST_F(Activation, ASocketOfAnotherNameIsRefused) {
  const std::string address = AddressToComeBackTo();
  StartActivated({address}, "web");
  (void)Curl("http://" + address + "/readyz");
  EXPECT_EQ(server_->Wait(), 2);
  EXPECT_NE(server_->Stderr().find("no door for a socket named 'web'"), std::string::npos) << server_->Stderr();
}

}  // namespace
}  // namespace dhpmap::testing
