// SPDX-License-Identifier: BSD-3-Clause
// TLS at both doors of a real server, its reload, and sockets of this machine.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <memory>
#include <regex>
#include <string>

#include "tests/e2e/process.h"
#include "tests/support/eventually.h"
#include "tests/support/scenes.h"
#include "tests/unit/server/net/test_certificates.h"
#include "tests/unit/server/net/tls_client.h"

namespace dhpmap::testing {
namespace {

namespace fs = std::filesystem;

class TlsServer : public ::testing::Test {
 protected:
  void Start(const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {Program("dhpmap-server"), "--db", (folder_.path() / "maps.db").string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    server_ = std::make_unique<Process>(folder_.path(), command);
    const std::regex line("gRPC on (.+), REST on (.+)\n");
    ASSERT_TRUE(Eventually([&] {
      const std::string text = server_->Stdout();
      std::smatch match;
      if (!std::regex_search(text, match, line)) return server_->Wait(0).has_value();
      grpc_ = match[1];
      rest_ = match[2];
      return true;
    }));
    ASSERT_NE(rest_, "") << server_->Stderr();
  }
  void StartWithTls() {
    own_ = MakeCertificate(folder_.path(), "own", {.common_name = "first"});
    Start({"--grpc", "127.0.0.1:0", "--http", "127.0.0.1:0", "--set", "tls.cert=" + own_.cert, "--set",
           "tls.key=" + own_.key});
  }
  Outcome Dhpmap(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {Program("dhpmap"), "--server", grpc_});
    return RunProgram(folder_.path(), std::move(arguments));
  }
  static int PortOf(const std::string& address) { return std::stoi(address.substr(address.rfind(':') + 1)); }
  std::string NameAt(const std::string& address, const std::string& protocol) const {
    return TlsClient(PortOf(address), {.protocol = protocol}).common_name();
  }

  TempDir folder_;
  CertificateFiles own_;
  std::string grpc_, rest_;
  std::unique_ptr<Process> server_;
};

TEST_F(TlsServer, AnswersAtBothDoorsWhoTrustsIt) {
  StartWithTls();
  EXPECT_TRUE(rest_.starts_with("https://"));
  const Outcome listed = Dhpmap({"--ca", own_.cert, "maps"});
  EXPECT_EQ(listed.exit_code, 0) << listed.err;
  const CertificateFiles other = MakeCertificate(folder_.path(), "other");
  EXPECT_NE(Dhpmap({"--ca", other.cert, "maps"}).exit_code, 0);
  const Outcome in_the_clear = Dhpmap({"maps"});
  EXPECT_NE(in_the_clear.exit_code, 0);
  EXPECT_NE(in_the_clear.err.find("--ca"), std::string::npos) << in_the_clear.err;
  EXPECT_NE(Dhpmap({"--ca", (folder_.path() / "none").string(), "maps"}).exit_code, 0);

  TlsClient rest(PortOf(rest_), {.ca = own_.cert, .protocol = "http/1.1"});
  ASSERT_TRUE(rest.is_connected()) << rest.error();
  for (int i = 0; i < 2; ++i) {  // the connection stays
    ASSERT_TRUE(rest.Send("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"));
    EXPECT_TRUE(rest.Read().starts_with("HTTP/1.1 200"));
  }
  server_->Signal(SIGTERM);
  EXPECT_EQ(server_->Wait(), 0);
}

TEST_F(TlsServer, AnswersUnderItsNamesAloneOverTlsToo) {
  StartWithTls();
  TlsClient rest(PortOf(rest_), {.ca = own_.cert, .protocol = "http/1.1"});
  ASSERT_TRUE(rest.Send("GET /healthz HTTP/1.1\r\nHost: evil.example\r\nOrigin: https://evil.example\r\n\r\n"));
  const std::string answer = rest.Read();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 421")) << answer;
  EXPECT_NE(answer.find("HOST_NOT_ALLOWED"), std::string::npos);
}

TEST_F(TlsServer, ReadsItsFilesAgainAtSighupAndKeepsWhatItHasIfTheyDoNotFit) {
  StartWithTls();
  TlsClient before(PortOf(rest_), {.protocol = "http/1.1"});
  const CertificateFiles second = MakeCertificate(folder_.path(), "second", {.common_name = "second"});
  fs::copy_file(second.cert, own_.cert, fs::copy_options::overwrite_existing);
  server_->Signal(SIGHUP);
  EXPECT_TRUE(
      Eventually([&] { return server_->Stderr().find("is not that of the certificate") != std::string::npos; }));
  EXPECT_EQ(NameAt(grpc_, "h2"), "first");
  fs::copy_file(second.key, own_.key, fs::copy_options::overwrite_existing);
  server_->Signal(SIGHUP);
  EXPECT_TRUE(Eventually([&] { return NameAt(grpc_, "h2") == "second"; }));
  EXPECT_EQ(NameAt(rest_, "http/1.1"), "second");
  ASSERT_TRUE(before.Send("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"));
  EXPECT_TRUE(before.Read().starts_with("HTTP/1.1 200"));
}

TEST_F(TlsServer, DoesNotStartWithAKeyThatOthersMayRead) {
  const CertificateFiles own = MakeCertificate(folder_.path(), "own");
  ::chmod(own.key.c_str(), 0644);
  const Outcome started =
      RunProgram(folder_.path(), {Program("dhpmap-server"), "--db", (folder_.path() / "maps.db").string(), "--set",
                                  "tls.cert=" + own.cert, "--set", "tls.key=" + own.key});
  EXPECT_NE(started.exit_code, 0);
  EXPECT_NE(started.err.find("chmod 600"), std::string::npos) << started.err;
}

TEST_F(TlsServer, ListensOnSocketsOfThisMachine) {
  const std::string grpc = "unix:" + (folder_.path() / "grpc").string();
  const std::string rest = (folder_.path() / "http").string();
  Start({"--grpc", grpc, "--http", "unix:" + rest});
  const Outcome listed = Dhpmap({"maps"});
  EXPECT_EQ(listed.exit_code, 0) << listed.err;
  const Outcome asked = RunProgram(folder_.path(), {"curl", "-s", "--unix-socket", rest, "http://localhost/v1/maps"});
  EXPECT_NE(asked.out.find("\"maps\""), std::string::npos) << asked.out << asked.err;
  server_->Signal(SIGTERM);
  EXPECT_EQ(server_->Wait(), 0);
  EXPECT_FALSE(fs::exists(rest));
}

}  // namespace
}  // namespace dhpmap::testing
