// SPDX-License-Identifier: BSD-3-Clause
// Real processes: dhpmap-server, dhpmap and curl.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "dhpmap/v1/query_service.grpc.pb.h"
#include "dhpmap/v1/submap_service.grpc.pb.h"
#include "google/protobuf/util/json_util.h"
#include "google/protobuf/util/message_differencer.h"
#include "tests/e2e/rendered_dataset.h"
#include "tests/e2e/same_maps.h"
#include "tests/e2e/server_process.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

constexpr int kNumMapped = 12;

class Mapping : public ::testing::Test {
 protected:
  void SetUp() override { WriteRenderedDataset(dataset(), kNumMapped); }
  [[nodiscard]] std::filesystem::path root() const { return temp_.path(); }
  [[nodiscard]] std::filesystem::path dataset() const { return root() / "dataset"; }

  /// Maps frames [start, start + frames) and expects success.
  void Map(const ServerProcess& server, const std::string& map, int start, int frames,
           const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"map",     dataset().string(),    "--map",    map,
                                       "--start", std::to_string(start), "--frames", std::to_string(frames)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = server.Dhpmap(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find(std::to_string(frames) + " frames fused"), std::string::npos) << outcome.out;
  }

 private:
  TempDir temp_;
};

v1::QueryPointsRequest PointsOfInterest(const std::string& map) {
  v1::QueryPointsRequest request;
  request.set_map("maps/" + map);
  // Ball's near side, box's top, floor, wall, thin air.
  for (float value : {1.16f, -0.5f, 0.40f, 1.6f, 0.6f, 0.59f, 0.9f, 0.05f, 0.0f, 2.49f, 0.0f, 0.9f, 9.0f, 9.0f, 9.0f}) {
    request.add_packed_points_m(value);
  }
  return request;
}

v1::QueryPointsResponse Query(const ServerProcess& server, const v1::QueryPointsRequest& request) {
  grpc::ClientContext context;
  v1::QueryPointsResponse response;
  const grpc::Status status = v1::QueryService::NewStub(server.Connect())->QueryPoints(&context, request, &response);
  EXPECT_TRUE(status.ok()) << status.error_message();
  return response;
}

/// POST by curl; the body of the answer.
std::string Curl(const std::filesystem::path& directory, const std::string& url, const std::string& content_type,
                 const std::string& body) {
  const std::filesystem::path in = directory / "request", out = directory / "answer";
  std::ofstream(in, std::ios::binary) << body;
  const Outcome outcome = RunProgram(directory, {"curl", "--silent", "--show-error", "--fail-with-body", "-X", "POST",
                                                 "-H", "Content-Type: " + content_type, "-H", "Accept: " + content_type,
                                                 "--data-binary", "@" + in.string(), "-o", out.string(), url});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::ostringstream text;
  text << std::ifstream(out, std::ios::binary).rdbuf();
  return text.str();
}

TEST_F(Mapping, AnswersTheSameOverGrpcJsonAndProtobuf) {
  const ServerProcess server(root(), root() / "maps.db");
  ASSERT_TRUE(server.is_serving());
  Map(server, "room", 0, kNumMapped, {"--labels", "groundtruth"});
  const v1::QueryPointsRequest request = PointsOfInterest("room");
  const v1::QueryPointsResponse grpc_answer = Query(server, request);
  ASSERT_EQ(grpc_answer.results_size(), 5);
  EXPECT_EQ(grpc_answer.results(0).class_name(), "Ball");
  EXPECT_EQ(grpc_answer.results(1).class_name(), "Box");
  EXPECT_EQ(grpc_answer.results(2).class_name(), "Floor");
  EXPECT_EQ(grpc_answer.results(3).class_name(), "Wall");
  EXPECT_FALSE(grpc_answer.results(4).near_surface());

  const std::string url = server.http_url() + "/v1/maps/room:queryPoints";
  std::string json;
  ASSERT_TRUE(google::protobuf::util::MessageToJsonString(request, &json).ok());
  v1::QueryPointsResponse json_answer;
  ASSERT_TRUE(
      google::protobuf::util::JsonStringToMessage(Curl(root(), url, "application/json", json), &json_answer).ok());
  v1::QueryPointsResponse protobuf_answer;
  ASSERT_TRUE(
      protobuf_answer.ParseFromString(Curl(root(), url, "application/x-protobuf", request.SerializeAsString())));
  EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(grpc_answer, protobuf_answer));
  EXPECT_EQ(grpc_answer.SerializeAsString(), json_answer.SerializeAsString());
}

TEST_F(Mapping, PredictedIdsWithoutMeaningGiveTheSameObjects) {
  const ServerProcess server(root(), root() / "maps.db");
  ASSERT_TRUE(server.is_serving());
  Map(server, "room", 0, kNumMapped);
  const v1::QueryPointsResponse answer = Query(server, PointsOfInterest("room"));
  EXPECT_EQ(answer.results(0).class_name(), "ball");
  EXPECT_EQ(answer.results(1).class_name(), "box");
  EXPECT_NE(answer.results(0).instance_id(), answer.results(1).instance_id());
  EXPECT_EQ(GetMap(server, "room").num_submaps(), 5) << "floor, wall, ball, box and the unknown submap";
}

TEST_F(Mapping, AfterARestartGoesOnAsIfInOneGo) {
  for (const char* labels : {"groundtruth", "predicted"}) {
    SCOPED_TRACE(labels);
    const std::filesystem::path db = root() / (std::string(labels) + ".db");
    {
      ServerProcess server(root(), db);
      ASSERT_TRUE(server.is_serving());
      Map(server, "whole", 0, kNumMapped, {"--labels", labels});
      Map(server, "parts", 0, 5, {"--labels", labels, "--no-finish"});
      EXPECT_EQ(server.Terminate(), 0) << server.process().Stderr();
    }
    ServerProcess server(root(), db);
    ASSERT_TRUE(server.is_serving()) << server.process().Stderr();
    EXPECT_EQ(GetMap(server, "parts").num_frames(), 5);
    Map(server, "parts", 5, kNumMapped - 5, {"--labels", labels});
    EXPECT_EQ(GetMap(server, "parts").num_frames(), kNumMapped);
    ExpectSameMaps(server, "whole", "parts");
  }
}

TEST_F(Mapping, EndingTheServerWhileFramesComeInLosesNothingCommitted) {
  WriteRenderedDataset(dataset(), 60);
  for (const int signal : {SIGTERM, SIGKILL}) {
    SCOPED_TRACE(signal);
    const std::filesystem::path db = root() / ("signal" + std::to_string(signal) + ".db");
    std::int64_t num_frames = 0;
    {
      ServerProcess server(root(), db);
      ASSERT_TRUE(server.is_serving());
      Map(server, "room", 0, 10, {"--no-finish"});
      HeldFrame held(dataset(), 50);  // so that it has frames to send whenever the signal comes
      Process client(root(), {Program("dhpmap"), "--server", server.grpc_address(), "map", dataset().string(), "--map",
                              "room", "--start", "10"});
      ASSERT_TRUE(Eventually([&] { return GetMap(server, "room").num_frames() > 10; })) << client.Stderr();
      server.process().Signal(signal);
      const std::optional<int> exit_code = server.process().Wait();
      EXPECT_EQ(exit_code, signal == SIGKILL ? 128 + SIGKILL : 0) << server.process().Stderr();
      held.Release();
      EXPECT_TRUE(client.Wait().has_value()) << "the client must not hang";
    }
    ServerProcess server(root(), db);
    ASSERT_TRUE(server.is_serving()) << server.process().Stderr();
    num_frames = GetMap(server, "room").num_frames();
    EXPECT_GE(num_frames, 10);
    EXPECT_EQ(Query(server, PointsOfInterest("room")).results(0).class_name(), "ball");
    Map(server, "room", static_cast<int>(num_frames), 60 - static_cast<int>(num_frames));
    EXPECT_EQ(GetMap(server, "room").num_frames(), 60);
  }
}

TEST_F(Mapping, BadFramesAreSkippedOrRefusedOnceWithAReasonAndTheRestIsMapped) {
  const ServerProcess server(root(), root() / "maps.db");
  ASSERT_TRUE(server.is_serving());
  std::filesystem::remove(dataset() / "run1/000002_depth.tiff");
  std::filesystem::remove(dataset() / "run1/000003_depth.tiff");
  std::filesystem::resize_file(dataset() / "run1/000005_color.png", 60);
  std::ofstream(dataset() / "run1/000007_pose.txt") << "nan 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n";
  const Outcome outcome = server.Dhpmap({"map", dataset().string(), "--map", "room"});
  EXPECT_EQ(outcome.exit_code, 8) << "frames were refused";
  EXPECT_NE(outcome.out.find("8 frames fused"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("2 skipped, MISSING_FILE"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("1 refused, BAD_FRAME: the frame is not usable: depth_camera.color"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("1 refused, BAD_FRAME: the frame is not usable: map_from_sensor"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.err.find("000002_depth.tiff"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("000003_depth.tiff"), std::string::npos) << "one warning a kind";
  EXPECT_EQ(GetMap(server, "room").num_frames(), 8);
}

}  // namespace
}  // namespace dhpmap::testing
