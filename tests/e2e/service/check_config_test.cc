// SPDX-License-Identifier: BSD-3-Clause
// dhpmap-server --check-config: all that is wrong at once, and nothing is changed.
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "tests/e2e/service/service_fixture.h"
#include "tests/unit/server/net/test_certificates.h"

namespace dhpmap::testing {
namespace {

namespace fs = std::filesystem;

class CheckConfig : public ServiceTest {
 protected:
  [[nodiscard]] Outcome Check(std::vector<std::string> more) const {
    more.insert(more.begin(), "--check-config");
    return RunProgram(folder_.path(), Command(more));
  }
  /// Without what the programs said.
  [[nodiscard]] std::set<std::string> Names() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with("std")) names.insert(name);
    }
    return names;
  }
};

TEST_F(CheckConfig, OfAStartThatWouldGoWellIsZeroAndMakesNothing) {
  const std::set<std::string> before = Names();
  const Outcome checked = Check({"--grpc", "127.0.0.1:0", "--http", "unix:" + File("rest").string()});
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_NE(checked.out.find("is not there yet and would be made"), std::string::npos) << checked.out;
  EXPECT_NE(checked.out.find("ready to start"), std::string::npos) << checked.out;
  EXPECT_EQ(Names(), before);
}

TEST_F(CheckConfig, EveryFaultIsNamedAtOnce) {
  const CertificateFiles own = MakeCertificate(folder_.path(), "own");
  ::chmod(own.key.c_str(), 0644);
  Write("maps.db", "this is no database");
  Write("keys", "this is no key\n");
  ::chmod(File("keys").c_str(), 0600);
  Write("file", "");
  const std::set<std::string> before = Names();
  const Outcome checked = Check(
      {"--set", "tls.cert=" + own.cert, "--set", "tls.key=" + own.key, "--set", "auth.keys=" + File("keys").string(),
       "--set", "auth.audit=" + File("none/audit").string(), "--set",
       "mapping.record_dir=" + File("file/records").string(), "--grpc", "192.0.2.1:1", "--http", "name.invalid:1"});
  EXPECT_EQ(checked.exit_code, 2);
  for (const char* fault :
       {"tls: ", "auth.keys: ", "auth.audit: ", "db: ", "mapping.record_dir: ", "grpc.address: ", "http.address: "}) {
    EXPECT_NE(checked.err.find(std::string("dhpmap-server: ") + fault), std::string::npos) << fault << checked.err;
  }
  EXPECT_EQ(Names(), before);
}

TEST_F(CheckConfig, SettingsThatCannotBeReadAreTwo) {
  EXPECT_EQ(Check({"--set", "store.commit_s=soon", "--set", "log.level=loud"}).exit_code, 2);
}

TEST_F(CheckConfig, APortThatIsTakenIsAFaultUnlessTheServerThatRunsHasIt) {
  Start();
  const std::string ready = manager_.NextThatBegins("READY=1");
  ASSERT_NE(ready, "") << server_->Stderr();
  const std::string rest = RestUrlIn(ready).substr(7);
  const Outcome same = Check({"--http", rest});
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_NE(same.out.find("in use by process " + std::to_string(server_->pid())), std::string::npos) << same.out;
  const Outcome other =
      RunProgram(folder_.path(), {Program("dhpmap-server"), "--check-config", "--db", File("other.db").string(),
                                  "--grpc", "127.0.0.1:0", "--http", rest});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("http.address: cannot listen on " + rest), std::string::npos) << other.err;
  EndServer();
}

TEST_F(CheckConfig, AnUpgradeIsForetold) {
  fs::copy_file(SourceDir() / "tests/unit/storage/released/schema-12.sqlite", File("maps.db"));
  fs::permissions(File("maps.db"), fs::perms::owner_write, fs::perm_options::add);
  const std::set<std::string> before = Names();
  const std::vector<std::string> doors = {"--grpc", "127.0.0.1:0", "--http", "127.0.0.1:0"};
  const Outcome checked = Check(doors);
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_NE(checked.out.find("from schema 12 to "), std::string::npos) << checked.out;
  EXPECT_NE(checked.out.find("maps.db.before-v"), std::string::npos) << checked.out;
  std::vector<std::string> without = doors;
  without.emplace_back("--no-backup");
  EXPECT_NE(Check(without).out.find("without a copy"), std::string::npos);
  EXPECT_EQ(Names(), before);
}

}  // namespace
}  // namespace dhpmap::testing
