// SPDX-License-Identifier: BSD-3-Clause
// Sessions of frames with real processes: servers that are killed, clients that freeze, frames over curl.
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/e2e/rendered_dataset.h"
#include "tests/e2e/same_maps.h"
#include "tests/e2e/server_process.h"
#include "tests/integration/feeder.h"
#include "tests/support/eventually.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

/// A variable of the environment, for processes that are started while it lives.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
  ~Environment() { unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
};

void Create(const ServerProcess& server, const std::string& map_id) {
  grpc::ClientContext context;
  v1::CreateMapResponse response;
  const grpc::Status status =
      v1::MapService::NewStub(server.Connect())->CreateMap(&context, CreateRequest(map_id), &response);
  ASSERT_TRUE(status.ok()) << status.error_message();
}

void FinishMapping(const ServerProcess& server, const std::string& map_id) {
  grpc::ClientContext context;
  v1::FinishMappingRequest request;
  request.set_map("maps/" + map_id);
  v1::FinishMappingResponse response;
  ASSERT_TRUE(v1::MappingService::NewStub(server.Connect())->FinishMapping(&context, request, &response).ok());
}

class Session : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path root() const { return temp_.path(); }
  [[nodiscard]] std::filesystem::path db() const { return root() / "maps.db"; }
  [[nodiscard]] std::filesystem::path dataset() const { return root() / "dataset"; }

 private:
  TempDir temp_;
};

TEST_F(Session, AServerThatIsKilledHasAllItSaidWasStoredAndTheClientGoesOnThere) {
  constexpr int kNumFrames = 36;
  const Environment few("DHPMAP_STORE_COMMIT_FRAMES", "3");
  std::int64_t told = -1;
  for (const int kill_at : {9, 17, 30}) {
    ServerProcess server(root(), db());
    ASSERT_TRUE(server.is_serving()) << server.process().Stderr();
    if (told < 0) Create(server, "parts");
    const auto mapping = v1::MappingService::NewStub(server.Connect());
    Feeder feeder(*mapping, "parts", {.session = "robot"});
    const auto greeting = feeder.Greet();
    ASSERT_TRUE(greeting);
    const std::int64_t stored = greeting->has_committed_sequence() ? greeting->committed_sequence() : -1;
    EXPECT_GE(stored, told);
    EXPECT_EQ(GetMap(server, "parts").num_frames(), stored + 1) << "frames and their session in one transaction";
    for (auto next = static_cast<int>(stored) + 1; next <= kill_at || told <= stored; ++next) {
      ASSERT_LT(next, kNumFrames) << "nothing is ever stored";
      const auto ack = feeder.Feed(next);
      ASSERT_TRUE(ack);
      EXPECT_EQ(ack->outcome(), v1::IntegrateFramesResponse::FUSED);
      if (ack->has_committed_sequence()) told = ack->committed_sequence();
    }
    server.process().Signal(SIGKILL);
    EXPECT_EQ(server.process().Wait(), 128 + SIGKILL);
    EXPECT_EQ(feeder.Finish().error_code(), grpc::UNAVAILABLE);
  }
  const ServerProcess server(root(), db());
  ASSERT_TRUE(server.is_serving());
  const auto mapping = v1::MappingService::NewStub(server.Connect());
  Feeder feeder(*mapping, "parts", {.session = "robot"});
  const auto greeting = feeder.Greet();
  ASSERT_TRUE(greeting && greeting->has_committed_sequence());
  EXPECT_GE(greeting->committed_sequence(), told);
  for (auto next = static_cast<int>(greeting->committed_sequence()) + 1; next < kNumFrames; ++next) {
    ASSERT_TRUE(feeder.Feed(next));
  }
  feeder.HalfClose();
  ASSERT_TRUE(feeder.Finish().ok());
  EXPECT_EQ(GetMap(server, "parts").num_frames(), kNumFrames);

  Create(server, "whole");
  ASSERT_TRUE(Feed(*mapping, "whole", 0, kNumFrames).status.ok());
  for (const char* map : {"parts", "whole"}) FinishMapping(server, map);
  ExpectSameMaps(server, "whole", "parts");
}

TEST_F(Session, TheCommandGoesOnByItselfWhenTheServerComesBackAndSkipsWhatIsStoredTheNextTime) {
  constexpr int kNumFrames = 120;
  WriteRenderedDataset(dataset(), kNumFrames);
  const Environment few("DHPMAP_STORE_COMMIT_FRAMES", "5");
  const std::string address = AddressToComeBackTo();
  std::optional<Process> client;
  const auto start = [&] {
    client.emplace(
        root(), std::vector<std::string>{Program("dhpmap"), "--server", address, "map", dataset().string(), "--map",
                                         "room", "--session", "run-1", "--reconnect-s", std::to_string(kPatience_s)});
  };
  {
    ServerProcess server(root(), db(), address);
    ASSERT_TRUE(server.is_serving()) << server.process().Stderr();
    EXPECT_EQ(server.Dhpmap({"map", dataset().string(), "--map", "room", "--frames", "4", "--no-finish"}).exit_code, 0);
    const HeldFrame held(dataset(), kNumFrames - 20);  // so that it has frames to send when the server is killed
    start();
    ASSERT_TRUE(Eventually([&] { return GetMap(server, "room").num_frames() > 20; })) << client->Stderr();
    server.process().Signal(SIGKILL);
    server.process().Wait();
  }
  ServerProcess server(root(), db(), address);
  ASSERT_TRUE(server.is_serving()) << server.process().Stderr();
  EXPECT_EQ(client->Wait(), 0) << client->Stderr();
  EXPECT_NE(client->Stderr().find("the connection is lost"), std::string::npos) << client->Stderr();
  EXPECT_NE(client->Stdout().find(std::to_string(kNumFrames) + " frames stored\n"), std::string::npos)
      << client->Stdout();
  EXPECT_EQ(GetMap(server, "room").num_frames(), 4 + kNumFrames) << "each frame of the session once";

  start();
  EXPECT_EQ(client->Wait(), 0) << client->Stderr();
  EXPECT_NE(client->Stdout().find("0 frames fused\n120 frames stored, 120 of them before"), std::string::npos)
      << client->Stdout();
  EXPECT_EQ(GetMap(server, "room").num_frames(), 4 + kNumFrames);
}

/// A client that has been frozen in the middle of its frames.
class FrozenClient : public Session, public ::testing::WithParamInterface<const char*> {
 protected:
  static constexpr int kNumFrames = 60;
};

TEST_P(FrozenClient, DoesNotHoldItsMap) {
  const std::string cure = GetParam();
  const Environment idle("DHPMAP_MAPPING_FEED_IDLE_S", cure == "idle" || cure == "deletion" ? "1" : "86400");
  const Environment keepalive("DHPMAP_GRPC_KEEPALIVE_S", cure == "keepalive" ? "1" : "86400");
  WriteRenderedDataset(dataset(), kNumFrames);
  const ServerProcess server(root(), db());
  ASSERT_TRUE(server.is_serving());
  ASSERT_EQ(server.Dhpmap({"map", dataset().string(), "--map", "room", "--frames", "1"}).exit_code, 0);
  HeldFrame held(dataset(), kNumFrames / 2);
  Process client(root(), {Program("dhpmap"), "--server", server.grpc_address(), "map", dataset().string(), "--map",
                          "room", "--no-finish"});
  ASSERT_TRUE(Eventually([&] { return GetMap(server, "room").num_frames() > 10; })) << client.Stderr();
  client.Signal(SIGSTOP);
  std::vector<std::string> other{"map", dataset().string(), "--map", "room", "--frames", "1"};
  if (cure == "take-over") other.emplace_back("--take-over");
  if (cure == "deletion") other = {"maps", "delete", "room", "--yes"};
  Outcome outcome;
  Eventually([&] {
    outcome = server.Dhpmap(other);
    return outcome.exit_code == 0 || cure == "take-over";
  });
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;

  client.Signal(SIGCONT);
  held.Release();
  const std::optional<int> exit_code = client.Wait();
  ASSERT_TRUE(exit_code.has_value()) << "it must not hang";
  EXPECT_NE(*exit_code, 0) << "most of its frames were not taken";
  if (cure == "take-over") {
    EXPECT_NE(client.Stderr().find("FEED_TAKEN_OVER"), std::string::npos) << client.Stderr();
  }
  if (cure == "idle") {
    EXPECT_NE(client.Stderr().find("FEED_IDLE"), std::string::npos) << client.Stderr();
  }
}

INSTANTIATE_TEST_SUITE_P(Cures, FrozenClient, ::testing::Values("take-over", "idle", "keepalive", "deletion"),
                         [](const auto& cure) {
                           std::string name = cure.param;
                           std::erase(name, '-');
                           return name;
                         });

// One frame over REST.

struct HttpAnswer {
  std::string status, body;
};

HttpAnswer Post(const std::filesystem::path& directory, const std::string& url, const v1::IntegrateFramesRequest& frame,
                const std::vector<std::string>& more = {}) {
  std::string json;
  EXPECT_TRUE(google::protobuf::util::MessageToJsonString(frame, &json).ok());
  const std::filesystem::path in = directory / "request.json", out = directory / "answer.json";
  std::ofstream(in, std::ios::binary) << json;
  std::vector<std::string> command{"curl",
                                   "--silent",
                                   "--show-error",
                                   "-X",
                                   "POST",
                                   "-H",
                                   "Content-Type: application/json",
                                   "--data-binary",
                                   "@" + in.string(),
                                   "-o",
                                   out.string(),
                                   "-w",
                                   "%{http_code}",
                                   url};
  command.insert(command.end(), more.begin(), more.end());
  const Outcome outcome = RunProgram(directory, command);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::ostringstream text;
  text << std::ifstream(out, std::ios::binary).rdbuf();
  return {outcome.out, text.str()};
}

TEST_F(Session, ASingleFrameOverRestIsStoredOrAnErrorOfHttp) {
  const ServerProcess server(root(), db());
  ASSERT_TRUE(server.is_serving());
  Create(server, "room");
  const std::string url = server.http_url() + "/v1/maps/room:integrateFrames";
  for (const std::vector<std::string>& how : {std::vector<std::string>{}, {"-H", "Transfer-Encoding: chunked"}}) {
    v1::IntegrateFramesRequest request;
    request.set_sequence(7);
    *request.mutable_frame() = TestFrame(0);
    const HttpAnswer good = Post(root(), url, request, how);
    EXPECT_EQ(good.status, "200") << good.body;
    EXPECT_EQ(std::count(good.body.begin(), good.body.end(), '\n'), 1) << "one answer: " << good.body;
    EXPECT_NE(good.body.find(R"("committed_sequence":"7")"), std::string::npos) << good.body;
    EXPECT_NE(good.body.find(R"("outcome":"FUSED")"), std::string::npos) << good.body;

    request.mutable_frame()->mutable_depth_camera()->mutable_depth()->mutable_data()->pop_back();
    const HttpAnswer bad = Post(root(), url, request, how);
    EXPECT_EQ(bad.status, "400") << bad.body;
    EXPECT_NE(bad.body.find("depth_camera.depth"), std::string::npos) << bad.body;
    EXPECT_NE(bad.body.find("google.rpc.ErrorInfo"), std::string::npos) << bad.body;
  }
  v1::IntegrateFramesRequest nothing;
  EXPECT_EQ(Post(root(), url, nothing).status, "400");
  nothing.set_session("robot");
  EXPECT_EQ(Post(root(), url, nothing).status, "200") << "asks how far the session has got";
  EXPECT_EQ(GetMap(server, "room").num_frames(), 2);
}

}  // namespace
}  // namespace dhpmap::testing
