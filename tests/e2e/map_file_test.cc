// SPDX-License-Identifier: BSD-3-Clause
// One map goes out of a real server as a file and into others, through every door, and with the server killed
// meanwhile.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdint>
#include <fstream>
#include <memory>
#include <sstream>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "tests/e2e/rendered_dataset.h"
#include "tests/e2e/same_maps.h"
#include "tests/e2e/server_process.h"
#include "tests/e2e/test_database.h"
#include "tests/support/eventually.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

namespace fs = std::filesystem;

std::string ReadAll(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

class MapFiles : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    temp_ = new TempDir();
    WriteRenderedDataset(temp_->path() / "dataset", 6);
    server_ = new ServerProcess(temp_->path(), temp_->path() / "maps.db");
    ASSERT_TRUE(server_->is_serving()) << server_->process().Stderr();
    Outcome outcome = server_->Dhpmap({"map", File("dataset"), "--map", "room", "--labels", "groundtruth"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    outcome = server_->Dhpmap({"maps", "export", "room", File("room.dhpmap")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  static void TearDownTestSuite() {
    delete server_;
    delete temp_;
  }
  static std::string File(const std::string& name) { return (temp_->path() / name).string(); }
  static Outcome Run(std::vector<std::string> arguments) { return server_->Dhpmap(std::move(arguments)); }
  static Outcome Curl(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"curl", "-s", "-S", "-w", "\n%{http_code}"});
    return RunProgram(temp_->path(), std::move(arguments));
  }
  static std::string Url(const std::string& rest) { return server_->http_url() + "/v1/" + rest; }

  static TempDir* temp_;
  static ServerProcess* server_;
};
TempDir* MapFiles::temp_ = nullptr;
ServerProcess* MapFiles::server_ = nullptr;

TEST_F(MapFiles, AreTheSameBytesThroughEveryDoor) {
  const std::string bytes = ReadAll(File("room.dhpmap"));
  ASSERT_GT(bytes.size(), 100'000u);
  ASSERT_EQ(RunProgram(temp_->path(), {"curl", "-sf", "-o", File("fetched"), Url("maps/room:export")}).exit_code, 0);
  EXPECT_TRUE(ReadAll(File("fetched")) == bytes);
  EXPECT_TRUE(Run({"maps", "export", "room", "-"}).out == bytes);
  EXPECT_EQ(Run({"maps", "export", "room", File("room.dhpmap")}).exit_code, 1) << "not over a file that is there";
}

TEST_F(MapFiles, ComeInThroughEveryDoor) {
  const Outcome typed = Run({"maps", "import", File("room.dhpmap"), "--map", "typed"});
  EXPECT_EQ(typed.exit_code, 0) << typed.err;
  EXPECT_NE(typed.out.find("maps/typed holds"), std::string::npos) << typed.out;
  const Outcome posted = Curl({"--data-binary", "@" + File("room.dhpmap"), Url("maps:import?mapId=posted")});
  EXPECT_TRUE(posted.out.ends_with("\n200")) << posted.out << posted.err;
  EXPECT_NE(posted.out.find("maps/posted"), std::string::npos) << posted.out;
  const Outcome chunked =
      Curl({"-X", "POST", "-H", "Transfer-Encoding: chunked", "-H", "Content-Type: application/vnd.sqlite3", "-T",
            File("room.dhpmap"), Url("maps:import?map_id=chunked")});
  EXPECT_TRUE(chunked.out.ends_with("\n200")) << chunked.out << chunked.err;
  for (const char* map : {"typed", "posted", "chunked"}) {
    SCOPED_TRACE(map);
    ExpectSameMaps(*server_, "room", map);
    EXPECT_EQ(Run({"verify", map}).exit_code, 0);
  }
  ServerProcess other(File(""), File("other.db"));
  ASSERT_TRUE(other.is_serving()) << other.process().Stderr();
  EXPECT_EQ(other.Dhpmap({"maps", "import", File("room.dhpmap")}).exit_code, 0);
  EXPECT_NE(other.Dhpmap({"submaps", "room"}).out.find("Ball"), std::string::npos);
  EXPECT_EQ(other.Terminate(), 0);
}

TEST_F(MapFiles, ThatAreNoGoodAreTypedErrorsOfEveryDoor) {
  const std::string bytes = ReadAll(File("room.dhpmap"));
  std::ofstream(File("half"), std::ios::binary) << bytes.substr(0, bytes.size() / 2 / 4096 * 4096);
  std::ofstream(File("picture"), std::ios::binary) << std::string(10'000, 'p');
  std::ofstream(File("empty"), std::ios::binary);
  EXPECT_EQ(Run({"maps", "import", File("room.dhpmap"), "--map", "room"}).exit_code, 4);
  EXPECT_EQ(Run({"maps", "import", File("picture"), "--map", "bad"}).exit_code, 2);
  EXPECT_EQ(Run({"maps", "import", File("half"), "--map", "bad"}).exit_code, 2);
  EXPECT_EQ(Run({"maps", "import", File("none"), "--map", "bad"}).exit_code, 7);
  EXPECT_EQ(Run({"maps", "export", "nowhere", File("nowhere")}).exit_code, 3);
  EXPECT_FALSE(fs::exists(File("nowhere")) || fs::exists(File("nowhere.part")));
  struct Case {
    const char* file;
    const char* query;
    const char* status;
    const char* reason;
  };
  for (const Case& one :
       {Case{"room.dhpmap", "?map_id=room", "409", "MAP_EXISTS"}, Case{"picture", "?map_id=bad", "400", "BAD_MAP"},
        Case{"half", "?map_id=bad", "400", "BAD_MAP"}, Case{"empty", "?map_id=bad", "400", "BAD_MAP"},
        Case{"room.dhpmap", "?map_id=A/B", "400", "BAD_NAME"}}) {
    SCOPED_TRACE(std::string(one.file) + one.query);
    const Outcome answer = Curl({"--data-binary", "@" + File(one.file), Url(std::string("maps:import") + one.query)});
    EXPECT_TRUE(answer.out.ends_with(std::string("\n") + one.status)) << answer.out;
    EXPECT_NE(answer.out.find(one.reason), std::string::npos) << answer.out;
  }
  EXPECT_EQ(Run({"maps", "show", "bad"}).exit_code, 3);
  EXPECT_TRUE(Curl({Url("maps/nowhere:export")}).out.ends_with("\n404"));
}

/// What lies beside a database that is not part of it.
struct Strangers {
  int count = 0;
  std::uintmax_t bytes = 0;
};
Strangers StrangersIn(const fs::path& folder) {
  Strangers found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().find("-backup-") == std::string::npos) continue;
    ++found.count;
    found.bytes += entry.file_size();
  }
  return found;
}

/// A server with a database of its own, into which a map comes.
class Incoming {
 public:
  Incoming() : server_(folder_.path(), db()), maps_(v1::MapService::NewStub(server_.Connect())) {
    EXPECT_TRUE(server_.is_serving()) << server_.process().Stderr();
    stream_ = maps_->ImportMap(&context_, &response_);
  }
  /// Sends so much of the file, and waits until the server has put it on the disk.
  bool Send(const std::string& bytes) {
    v1::ImportMapRequest part;
    part.set_map_id("copy");
    part.set_data(bytes);
    return stream_->Write(part) && Eventually([&] { return StrangersIn(folder_.path()).bytes == bytes.size(); });
  }
  /// What is sent is all.
  bool End() {
    stream_->WritesDone();
    return stream_->Finish().ok();
  }
  /// The kernel kills it in the middle of the write that would make a file longer than this.
  void KillBeyond(std::uintmax_t file_bytes) {
    const rlimit no_core{0, 0}, longest{file_bytes, file_bytes};
    EXPECT_EQ(::prlimit(server_.process().pid(), RLIMIT_CORE, &no_core, nullptr), 0);
    EXPECT_EQ(::prlimit(server_.process().pid(), RLIMIT_FSIZE, &longest, nullptr), 0);
  }
  /// Of the write-ahead log, to which all goes that comes into the database.
  [[nodiscard]] std::uintmax_t log_bytes() const { return fs::file_size(db().string() + "-wal"); }
  [[nodiscard]] const fs::path& folder() const { return folder_.path(); }
  [[nodiscard]] fs::path db() const { return folder_.path() / "maps.db"; }
  Process& process() { return server_.process(); }

 private:
  const TempDir folder_;
  ServerProcess server_;
  const std::unique_ptr<v1::MapService::Stub> maps_;
  grpc::ClientContext context_;
  v1::ImportMapResponse response_;
  std::unique_ptr<grpc::ClientWriter<v1::ImportMapRequest>> stream_;
};

/// That a server finds where another was killed: the map as a whole, or nothing of it.
void ExpectWholeOrNothing(const Incoming& killed) {
  ServerProcess server(killed.folder(), killed.db());
  ASSERT_TRUE(server.is_serving()) << server.process().Stderr();
  EXPECT_EQ(StrangersIn(killed.folder()).count, 0);
  const Outcome verified = server.Dhpmap({"verify", "copy"});
  EXPECT_TRUE(verified.exit_code == 0 || verified.exit_code == 3) << verified.out << verified.err;
  EXPECT_EQ(server.Terminate(), 0);
}

TEST_F(MapFiles, AServerThatIsKilledWhileTheFileComesHasNothingOfIt) {
  SKIP_ON_POSTGRES("files on their way lie in the folder for temporary files");
  const std::string bytes = ReadAll(File("room.dhpmap"));
  Incoming killed;
  ASSERT_TRUE(killed.Send(bytes.substr(0, bytes.size() / 2)));
  killed.process().Signal(SIGKILL);
  ASSERT_EQ(killed.process().Wait(), 128 + SIGKILL);
  EXPECT_FALSE(killed.End());
  EXPECT_EQ(StrangersIn(killed.folder()).count, 1) << "else the next server has nothing to clear away";
  ServerProcess server(killed.folder(), killed.db());
  ASSERT_TRUE(server.is_serving()) << server.process().Stderr();
  EXPECT_EQ(StrangersIn(killed.folder()).count, 0);
  EXPECT_EQ(server.Dhpmap({"verify", "copy"}).exit_code, 3);
}

TEST_F(MapFiles, AServerThatIsKilledWhileOneIsTakenInHasItAsAWholeOrNotAtAll) {
  SKIP_ON_POSTGRES("there is no write-ahead log to count the bytes of");
  const std::string bytes = ReadAll(File("room.dhpmap"));
  std::uintmax_t written_bytes = 0;
  {
    Incoming undisturbed;
    ASSERT_TRUE(undisturbed.Send(bytes));
    const std::uintmax_t before_bytes = undisturbed.log_bytes();
    ASSERT_TRUE(undisturbed.End());
    written_bytes = undisturbed.log_bytes() - before_bytes;
  }
  ASSERT_GT(written_bytes, bytes.size() / 2);
  constexpr unsigned kKills = 8;
  for (unsigned n = 0; n < kKills; ++n) {
    SCOPED_TRACE(n);
    Incoming killed;
    ASSERT_TRUE(killed.Send(bytes));
    killed.KillBeyond(killed.log_bytes() + written_bytes * n / kKills);
    EXPECT_FALSE(killed.End());
    ASSERT_EQ(killed.process().Wait(), 128 + SIGXFSZ) << killed.process().Stderr();
    ExpectWholeOrNothing(killed);
  }
}

}  // namespace
}  // namespace dhpmap::testing
