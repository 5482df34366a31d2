// SPDX-License-Identifier: BSD-3-Clause
// What a server says and does whose store does not keep up.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/e2e/rest_fixture.h"
#include "tests/e2e/test_database.h"
#include "tests/integration/feeder.h"
#include "tests/support/eventually.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

/// While it lives nobody can write to a database that is open somewhere, as while another process is in the middle of a
/// transaction: the lock on the index of the write-ahead log that https://sqlite.org/walformat.html calls
/// WAL_WRITE_LOCK.
class WriteAheadLogLock {
 public:
  explicit WriteAheadLogLock(const std::filesystem::path& db)
      : index_(::open((db.string() + "-shm").c_str(), O_RDWR | O_CLOEXEC)) {
    struct flock lock {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    lock.l_start = 120;
    lock.l_len = 1;
    is_held_ = index_ >= 0 && ::fcntl(index_, F_SETLKW, &lock) == 0;
  }
  ~WriteAheadLogLock() {
    if (index_ >= 0) ::close(index_);  // with the lock
  }
  WriteAheadLogLock(const WriteAheadLogLock&) = delete;
  WriteAheadLogLock& operator=(const WriteAheadLogLock&) = delete;

  [[nodiscard]] bool is_held() const { return is_held_; }

 private:
  int index_;
  bool is_held_ = false;
};

class StoreBehind : public RestTest {
 protected:
  static constexpr double kMaxBehind_s = 0.3;

  void SetUp() override {
    SKIP_ON_POSTGRES("there is no write-ahead log to lock");
    Start({{"DHPMAP_STORE_MAX_BEHIND_S", std::to_string(kMaxBehind_s)},
           {"DHPMAP_STORE_COMMIT_FRAMES", "1"},
           {"DHPMAP_STORE_RETRY_S", "0.02"},
           {"DHPMAP_STORE_BUSY_TIMEOUT_S", "0.01"},
           {"DHPMAP_MAPPING_PUBLISH_FRAMES", "1"}});
    Create("room");
  }
  int Readiness() const { return Ask("GET", "/readyz").status; }
  /// What /metrics says of the map; -1: nothing.
  double BehindSeconds() const {
    const std::string text = Ask("GET", "/metrics").body, name = "\ndhpmap_store_behind_seconds{map=\"room\"} ";
    const std::size_t at = text.find(name);
    return at == std::string::npos ? -1 : std::stod(text.substr(at + name.size()));
  }
};

TEST_F(StoreBehind, TheServerIsNotReadyAndRefusesFramesUntilTheStoreHasCaughtUp) {
  Feeder feeder(*mapping_, "room", {.session = "robot"});
  ASSERT_EQ(feeder.Feed(0)->outcome(), v1::IntegrateFramesResponse::FUSED);
  ASSERT_TRUE(Eventually([&] { return BehindSeconds() == 0; })) << "all is stored";
  EXPECT_EQ(Readiness(), 200);
  {
    const WriteAheadLogLock lock(db());
    ASSERT_TRUE(lock.is_held());
    const auto fused = feeder.Feed(1);
    ASSERT_TRUE(fused);
    EXPECT_EQ(fused->outcome(), v1::IntegrateFramesResponse::FUSED) << "the store has only just begun to be behind";
    EXPECT_FALSE(fused->committed());
    EXPECT_TRUE(Eventually([&] { return Readiness() == 503; }));
    const double then_s = BehindSeconds();
    EXPECT_GT(then_s, kMaxBehind_s);
    EXPECT_TRUE(Eventually([&] { return BehindSeconds() > then_s; })) << "it rises as long as nothing is stored";
    EXPECT_EQ(Ask("GET", "/healthz").status, 200) << "alive, but not ready";

    const auto refused = feeder.Feed(2);
    ASSERT_TRUE(refused) << "the stream goes on";
    EXPECT_EQ(refused->outcome(), v1::IntegrateFramesResponse::REFUSED);
    EXPECT_EQ(refused->error().code(), grpc::UNAVAILABLE);
    EXPECT_EQ(ReasonOf(refused->error()), "STORE_BEHIND");
    const http::HttpAnswer over_rest = PostFrame("room", "another", 2);
    EXPECT_EQ(over_rest.status, 503) << over_rest.body;
    EXPECT_NE(over_rest.body.find("STORE_BEHIND"), std::string::npos) << over_rest.body;
    EXPECT_EQ(Readiness(), 503);
  }
  EXPECT_TRUE(Eventually([&] { return Readiness() == 200; }));
  EXPECT_EQ(feeder.Feed(3)->outcome(), v1::IntegrateFramesResponse::FUSED);
  feeder.HalfClose();
  const grpc::Status ended = feeder.Finish();
  EXPECT_TRUE(ended.ok()) << ended.error_message();
  ASSERT_TRUE(feeder.last());
  EXPECT_EQ(feeder.last()->committed_sequence(), 3);
  EXPECT_EQ(BehindSeconds(), 0);
  EXPECT_EQ(Get<v1::GetMapResponse>("maps/room").map().num_frames(), 3) << "those that were fused, and no other";
}

}  // namespace
}  // namespace dhpmap::testing
