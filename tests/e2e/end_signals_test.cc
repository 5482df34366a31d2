// SPDX-License-Identifier: BSD-3-Clause
// Whatever politely ends the server, what was fused is stored; what it is to ignore it does.
#include <gtest/gtest.h>

#include <csignal>
#include <cstring>

#include "dhpmap/v1/mapping_service.pb.h"
#include "tests/e2e/rest_fixture.h"

namespace dhpmap::testing {
namespace {

constexpr double kPatience_s = 20;

/// How this process, and what it starts, takes SIGHUP, until the end.
class HangUp {
 public:
  explicit HangUp(void (*taken)(int)) : before_(std::signal(SIGHUP, taken)) {}
  ~HangUp() { std::signal(SIGHUP, before_); }
  HangUp(const HangUp&) = delete;
  HangUp& operator=(const HangUp&) = delete;

 private:
  void (*before_)(int);
};

class EndSignals : public RestTest {
 protected:
  /// A server that stores nothing of its own accord, with frames that it has fused.
  void StartWithFrames() {
    Start({{"DHPMAP_STORE_COMMIT_S", "3600"}, {"DHPMAP_STORE_COMMIT_FRAMES", "1000"}});
    Create("room");
    for (int frame = 0; frame < kFrames; ++frame) {
      const http::HttpAnswer answer = PostFrame("room", "robot", frame);
      ASSERT_EQ(answer.status, 200) << answer.body;
    }
  }
  static constexpr int kFrames = 3;
};

TEST_F(EndSignals, StoreWhatIsFused) {
  const HangUp as_usual(SIG_DFL);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGUSR1}) {
    SCOPED_TRACE(strsignal(signal));
    StartWithFrames();
    server_->process().Signal(signal);
    EXPECT_EQ(server_->process().Wait(kPatience_s), 0) << server_->process().Stderr();
    Start();
    EXPECT_EQ(Get<v1::GetMapResponse>("maps/room").map().num_frames(), kFrames);
    EXPECT_EQ(Ask("DELETE", "/v1/maps/room").status, 200);
    ASSERT_EQ(server_->Terminate(), 0);
  }
}

TEST_F(EndSignals, MayComeAgainWhileATerminalHangsUp) {
  const HangUp as_usual(SIG_DFL);
  StartWithFrames();
  server_->process().Signal(SIGHUP);
  for (int i = 0; i < 100; ++i) server_->process().Signal(SIGHUP);
  EXPECT_EQ(server_->process().Wait(kPatience_s), 0) << server_->process().Stderr();
}

TEST_F(EndSignals, LeaveAServerAloneThatNohupHasStarted) {
  const HangUp ignored(SIG_IGN);
  StartWithFrames();
  server_->process().Signal(SIGHUP);
  EXPECT_EQ(Get<v1::GetMapResponse>("maps/room").map().num_frames(), kFrames);
  EXPECT_EQ(server_->Terminate(), 0);
  const std::string log = server_->process().Stderr();
  EXPECT_NE(log.find("got signal " + std::to_string(SIGTERM)), std::string::npos) << log;
}

}  // namespace
}  // namespace dhpmap::testing
