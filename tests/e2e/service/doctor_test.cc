// SPDX-License-Identifier: BSD-3-Clause
// dhpmap doctor, of servers that are well and of some that are not.
#include <csignal>

#include "tests/e2e/service/service_fixture.h"
#include "tests/unit/server/net/test_certificates.h"

namespace dhpmap::testing {
namespace {

class DoctorVisits : public ServiceTest {
 protected:
  void StartAndWait(const std::vector<std::string>& more = {}) {
    Start(more);
    const std::string ready = manager_.NextThatBegins("READY=1");
    std::smatch match;
    ASSERT_TRUE(std::regex_search(ready, match, std::regex("gRPC on ([0-9.]+:[0-9]+)"))) << server_->Stderr();
    grpc_ = match[1];
  }
  [[nodiscard]] Outcome Doctor(std::vector<std::string> more) const {
    more.insert(more.begin(), {Program("dhpmap"), "doctor"});
    return RunProgram(folder_.path(), std::move(more));
  }
  static bool HasLine(const Outcome& outcome, const std::string& beginning) {
    return ("\n" + outcome.out).find("\n" + beginning) != std::string::npos;
  }

  std::string grpc_;
};

TEST_F(DoctorVisits, AServerThatIsWellGetsAnOkForEach) {
  StartAndWait();
  const Outcome seen = Doctor({"--server", grpc_});
  for (const char* what : {"connection", "version", "clock", "readiness", "saving", "feeds"}) {
    EXPECT_TRUE(HasLine(seen, std::string("ok    ") + what + ": ")) << what << "\n" << seen.out << seen.err;
  }
  EXPECT_NE(seen.out.find("disk: "), std::string::npos) << "which may be full here";
  EXPECT_LE(seen.exit_code, HasLine(seen, "ok    disk") ? 0 : 2);
  const Outcome json = Doctor({"--server", grpc_, "--json"});
  EXPECT_NE(json.out.find("\"what\": \"version\",\n      \"health\": \"ok\""), std::string::npos) << json.out;
  EndServer();
  const Outcome gone = Doctor({"--server", grpc_});
  EXPECT_EQ(gone.exit_code, 2);
  EXPECT_TRUE(HasLine(gone, "fail  connection: ")) << gone.out;
}

TEST_F(DoctorVisits, WhatIsWrongWithACertificateIsSaid) {
  const CertificateFiles own = MakeCertificate(folder_.path(), "own");
  StartAndWait({"--set", "tls.cert=" + own.cert, "--set", "tls.key=" + own.key});
  const std::string named = "localhost" + grpc_.substr(grpc_.rfind(':'));
  EXPECT_TRUE(HasLine(Doctor({"--server", named, "--ca", own.cert}), "ok    connection: "));
  const Outcome blind = Doctor({"--server", named});
  EXPECT_EQ(blind.exit_code, 2);
  EXPECT_NE(blind.out.find("say with --ca"), std::string::npos) << blind.out;
  const CertificateFiles other = MakeCertificate(folder_.path(), "other");
  const Outcome stranger = Doctor({"--server", named, "--ca", other.cert});
  EXPECT_EQ(stranger.exit_code, 2);
  EXPECT_TRUE(HasLine(stranger, "fail  certificate: it is not to be trusted: ")) << stranger.out;
  const Outcome unread = Doctor({"--server", named, "--ca", File("none").string()});
  EXPECT_EQ(unread.exit_code, 2);
  EXPECT_TRUE(HasLine(unread, "fail  certificate: cannot read ")) << unread.out;
  EndServer();
}

TEST_F(DoctorVisits, ACertificateThatSoonEndsIsAWarning) {
  const CertificateFiles own = MakeCertificate(folder_.path(), "own");  // for a day
  StartAndWait({"--set", "tls.cert=" + own.cert, "--set", "tls.key=" + own.key});
  const Outcome seen = Doctor({"--server", "localhost" + grpc_.substr(grpc_.rfind(':')), "--ca", own.cert});
  EXPECT_TRUE(HasLine(seen, "warn  certificate: it is good for ")) << seen.out;
  EXPECT_NE(seen.exit_code, 0);
  EndServer();
}

TEST_F(DoctorVisits, WhereKeysAreOnItWantsOne) {
  const std::string keys = File("maps.db.keys").string();
  const Outcome made =
      RunProgram(folder_.path(), {Program("dhpmap"), "keys", "create", "anna", "--role", "viewer", "--keys", keys});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  Write("anna.key", made.out);
  std::filesystem::permissions(File("anna.key"), std::filesystem::perms::owner_read);
  StartAndWait();
  const Outcome without = Doctor({"--server", grpc_});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_NE(without.out.find("--token-file"), std::string::npos) << without.out;
  const Outcome with = Doctor({"--server", grpc_, "--token-file", File("anna.key").string()});
  EXPECT_TRUE(HasLine(with, "ok    readiness: ")) << with.out << with.err;
  EndServer();
}

TEST_F(DoctorVisits, WithoutTLSThereIsNoCertificateToTrust) {
  const CertificateFiles own = MakeCertificate(folder_.path(), "own");
  StartAndWait();
  const Outcome seen = Doctor({"--server", grpc_, "--ca", own.cert});
  EXPECT_EQ(seen.exit_code, 2);
  EXPECT_TRUE(HasLine(seen, "fail  certificate: the server does not speak TLS")) << seen.out;
  EndServer();
}

}  // namespace
}  // namespace dhpmap::testing
