// SPDX-License-Identifier: BSD-3-Clause
// ExportMap and ImportMap through the door. A failed import leaves nothing behind.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "server/grpc/client_lag.h"
#include "storage/sqlite_store.h"
#include "tests/integration/test_server.h"
#include "tests/support/eventually.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

class MapFileCalls : public ::testing::Test {
 protected:
  void SetUp() override {
    store_ = std::move(OpenSqliteStore((folder_.path() / "maps.db").string())).value();
    Start();
    ASSERT_OK(server_->Call(&MapStub::CreateMap, CreateRequest("room")));
    ASSERT_OK(Feed(*server_, "room", 0, 6));
    ASSERT_OK(Export("room", bytes_));
    ASSERT_GT(bytes_.size(), 50'000u);
    num_files_ = NumFiles();
  }
  void Start(const RegistryOptions& options = {}, GrpcOptions grpc = {}) {
    server_ = nullptr;
    server_ = std::make_unique<TestServer>(*store_, OpenMapOptions{}, std::move(grpc), GrpcObserver{}, options);
  }

  grpc::Status Export(const std::string& map, std::string& bytes) {
    const auto parts = server_->Call(&MapStub::ExportMap, "maps/" + map);
    bytes.clear();
    for (const auto& part : *parts) {
      EXPECT_LE(part.data().size(), 256u << 10);
      bytes += part.data();
    }
    EXPECT_EQ(parts->empty() ? 0 : parts->front().total_bytes(), static_cast<std::int64_t>(bytes.size()));
    return parts.status();
  }

  struct Sent {
    grpc::Status status;
    v1::ImportMapResponse response;
    std::size_t num_bytes = 0;  ///< sent by the client
  };
  /// `total_bytes`: as announced.
  Sent Import(const std::string& map_id, const std::string& bytes, std::int64_t total_bytes = 0) {
    constexpr std::size_t kPiece = 10'000;
    Sent sent;
    grpc::ClientContext context;
    const auto stream = server_->maps->ImportMap(&context, &sent.response);
    v1::ImportMapRequest part;
    part.set_map_id(map_id);
    part.set_total_bytes(total_bytes);
    for (bool is_taken = stream->Write(part); is_taken && sent.num_bytes < bytes.size();) {
      part.Clear();
      part.set_data(bytes.substr(sent.num_bytes, kPiece));
      is_taken = stream->Write(part);
      sent.num_bytes += part.data().size();
    }
    stream->WritesDone();
    sent.status = stream->Finish();
    return sent;
  }

  int NumFiles() const {
    return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder_.path()), {}));
  }
  void ExpectNothingLeft(const std::string& map) {
    EXPECT_EQ(NumFiles(), num_files_);
    EXPECT_EQ(server_->registry().Get(map).status().code(), StatusCode::kNotFound);
    EXPECT_EQ(store_->GetMap(map).status().code(), StatusCode::kNotFound);
  }

  TempDir folder_;
  std::unique_ptr<MapStore> store_;
  std::unique_ptr<TestServer> server_;
  std::string bytes_;
  int num_files_ = 0;
};

/// A map's answers, without its name.
std::map<std::string, std::string> AnswersOf(TestServer& server, const std::string& map_id) {
  std::map<std::string, std::string> answers;
  const auto keep = [&](const std::string& what, const google::protobuf::Message& answer) {
    std::string text = answer.DebugString();
    const std::string name = "maps/" + map_id + "/";
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at))
      text.replace(at, name.size(), "M/");
    answers[what] += text;
  };
  const std::string map = "maps/" + map_id;
  keep("points", server.Call(&QueryStub::QueryPoints, TestQuery(map_id)).value());
  auto distances = About<v1::QueryDistancesRequest>(map);
  distances.set_packed(true);
  *distances.mutable_packed_points_m() = TestQuery(map_id).packed_points_m();
  keep("distances", server.Call(&QueryStub::QueryDistances, distances).value());
  auto submaps = server.Call(&SubmapStub::ListSubmaps, map).value();
  for (v1::Submap& submap : *submaps.mutable_submaps()) submap.clear_etag();  // contains the history id
  keep("submaps", submaps);
  for (const v1::Submap& submap : submaps.submaps()) {
    for (const auto& part : server.Call(&SubmapStub::StreamSubmapVoxels, submap.name()).value()) keep("voxels", part);
  }
  for (const auto& part : server.Call(&SubmapStub::GetSubmapMesh, map).value()) keep("mesh", part);
  return answers;
}

TEST_F(MapFileCalls, AnExportedAndImportedMapAnswersAllQueriesTheSame) {
  const Sent sent = Import("copy", bytes_, static_cast<std::int64_t>(bytes_.size()));
  ASSERT_OK(sent.status);
  EXPECT_EQ(sent.response.map().name(), "maps/copy");
  EXPECT_EQ(NumFiles(), num_files_);
  std::string again;
  ASSERT_OK(Export("room", again));
  EXPECT_TRUE(again == bytes_) << "a state is always the same file";
  Start();  // the stored map is rounded, the one in memory is not
  const auto original = AnswersOf(*server_, "room"), copy = AnswersOf(*server_, "copy");
  ASSERT_EQ(original.size(), 5u);
  for (const auto& [what, answer] : original) {
    EXPECT_GT(answer.size(), 1000u) << what;
    EXPECT_TRUE(copy.at(what) == answer) << what;
  }
  const auto room = server_->registry().Get("room"), other = server_->registry().Get("copy");
  EXPECT_NE(room->info.history_id, other->info.history_id);
  EXPECT_EQ(room->info.revision, sent.response.revision());
  ASSERT_OK(Feed(*server_, "copy", 6, 9)) << "mapping goes on";
}

TEST_F(MapFileCalls, AnImportedMapKeepsItsNameByDefault) {
  ASSERT_OK(server_->Call(&MapStub::DeleteMap, "maps/room"));
  const Sent sent = Import("", bytes_);
  ASSERT_OK(sent.status);
  EXPECT_EQ(sent.response.map().name(), "maps/room");
  EXPECT_EQ(AnswersOf(*server_, "room").size(), 5u);
}

TEST_F(MapFileCalls, ATakenNameIsRefusedBeforeTheFileIsSent) {
  grpc::ClientContext context;
  v1::ImportMapResponse response;
  const auto stream = server_->maps->ImportMap(&context, &response);
  v1::ImportMapRequest first;
  first.set_map_id("room");
  ASSERT_TRUE(stream->Write(first));
  const grpc::Status status = stream->Finish();  // although the client did not half-close
  EXPECT_EQ(status.error_code(), grpc::ALREADY_EXISTS);
  EXPECT_EQ(ReasonOf(status), "MAP_EXISTS");
  EXPECT_EQ(Import("", bytes_).status.error_code(), grpc::ALREADY_EXISTS) << "the name that it had";
  EXPECT_EQ(Import("a/b", bytes_).status.error_code(), grpc::INVALID_ARGUMENT);
}

TEST_F(MapFileCalls, ANameTakenMeanwhileIsRefusedAtTheEnd) {
  grpc::ClientContext context;
  v1::ImportMapResponse response;
  const auto stream = server_->maps->ImportMap(&context, &response);
  v1::ImportMapRequest part;
  part.set_map_id("copy");
  part.set_data(bytes_);
  ASSERT_TRUE(stream->Write(part));
  ASSERT_TRUE(Eventually([&] { return NumFiles() > num_files_; }));
  ASSERT_OK_AND_ASSIGN(const auto made, server_->Call(&MapStub::CreateMap, CreateRequest("copy")));
  stream->WritesDone();
  EXPECT_EQ(stream->Finish().error_code(), grpc::ALREADY_EXISTS);
  EXPECT_EQ(NumFiles(), num_files_);
  EXPECT_EQ(server_->registry().Get("copy")->info.revision, made.revision()) << "the other's stands";
}

TEST_F(MapFileCalls, AnInvalidFileIsATypedErrorAndLeavesNothing) {
  std::string newer = bytes_, flipped = bytes_;
  newer[63] = 99;  // user_version, the last byte of it
  const std::size_t labels =
      bytes_.find(std::string("\x22\x01\x00\x28\xB5\x2F\xFD", 7));  // of a tile, as a frame of zstd
  ASSERT_NE(labels, std::string::npos);
  flipped[labels + 23] ^= 0x20;
  struct Case {
    const char* what;
    std::string bytes;
    std::int64_t total_bytes;
    grpc::StatusCode code;
    const char* reason;
  };
  const auto size = static_cast<std::int64_t>(bytes_.size());
  const Case cases[] = {
      {"nothing", "", 0, grpc::INVALID_ARGUMENT, "BAD_MAP"},
      {"a picture", std::string(30'000, 'p'), 0, grpc::INVALID_ARGUMENT, "BAD_MAP"},
      {"of a later version", newer, size, grpc::FAILED_PRECONDITION, "NEWER_SCHEMA"},
      {"damaged", flipped, size, grpc::DATA_LOSS, "DAMAGED_MAP"},
      {"less than announced", bytes_.substr(0, bytes_.size() - 1), size, grpc::INVALID_ARGUMENT, "BAD_MAP"},
      {"more than announced", bytes_ + "x", size, grpc::INVALID_ARGUMENT, "BAD_MAP"},
      {"of no size", bytes_, -1, grpc::INVALID_ARGUMENT, "BAD_MAP"},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.what);
    const Sent sent = Import("copy", one.bytes, one.total_bytes);
    EXPECT_EQ(sent.status.error_code(), one.code) << sent.status.error_message();
    EXPECT_EQ(ReasonOf(sent.status), one.reason) << sent.status.error_message();
    ExpectNothingLeft("copy");
  }
  std::string none;
  EXPECT_EQ(Export("nowhere", none).error_code(), grpc::NOT_FOUND);
  EXPECT_OK(Import("copy", bytes_));
}

TEST_F(MapFileCalls, ATooLargeFileIsRefusedWhenAnnouncedOrWhenTheLimitIsReached) {
  Start({.max_import_bytes = 50'000});
  const Sent told = Import("copy", bytes_, static_cast<std::int64_t>(bytes_.size()));
  EXPECT_EQ(told.status.error_code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_EQ(ReasonOf(told.status), "BODY_TOO_LARGE");
  const Sent untold = Import("copy", bytes_);
  EXPECT_EQ(untold.status.error_code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_EQ(ReasonOf(untold.status), "BODY_TOO_LARGE");
  ExpectNothingLeft("copy");
}

/// A client that has sent part of a file.
struct HalfSent {
  grpc::ClientContext context;
  v1::ImportMapResponse response;
  std::unique_ptr<grpc::ClientWriter<v1::ImportMapRequest>> stream;

  HalfSent(TestServer& server, const std::string& map_id, const std::string& bytes)
      : stream(server.maps->ImportMap(&context, &response)) {
    v1::ImportMapRequest part;
    part.set_map_id(map_id);
    part.set_data(bytes);
    (void)stream->Write(part);  // fails if the stream has ended
  }
};

TEST_F(MapFileCalls, ClientsThatDisconnectFreeTheirPlace) {
  auto one = std::make_unique<HalfSent>(*server_, "one", bytes_.substr(0, 20'000));
  auto two = std::make_unique<HalfSent>(*server_, "two", bytes_.substr(0, 20'000));
  ASSERT_TRUE(Eventually([&] { return NumFiles() == num_files_ + 2; }));
  const Sent third = Import("three", bytes_);
  EXPECT_EQ(third.status.error_code(), grpc::RESOURCE_EXHAUSTED);
  EXPECT_EQ(ReasonOf(third.status), "TOO_BUSY");

  one->context.TryCancel();
  two->context.TryCancel();
  EXPECT_TRUE(Eventually([&] { return NumFiles() == num_files_; }));
  EXPECT_EQ(one->stream->Finish().error_code(), grpc::CANCELLED);
  EXPECT_EQ(two->stream->Finish().error_code(), grpc::CANCELLED);
  EXPECT_OK(Import("three", bytes_));
  ExpectNothingLeft("one");
}

TEST_F(MapFileCalls, ASilentUploadIsEnded) {
  Start({}, {.import_idle_s = 0.05});
  HalfSent half(*server_, "copy", bytes_.substr(0, 20'000));
  const grpc::Status status = half.stream->Finish();
  EXPECT_EQ(status.error_code(), grpc::DEADLINE_EXCEEDED) << status.error_message();
  ExpectNothingLeft("copy");
}

/// The lag of a client that sends so many bytes after each wait of so many seconds.
double LagSeconds(int num_parts, std::size_t part_bytes, double wait_s) {
  using Clock = ClientLag::Clock;
  const auto wait = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(wait_s));
  ClientLag lag;
  Clock::time_point now;
  for (int i = 0; i < num_parts; ++i) {
    now += std::chrono::hours(1);  // processing time, which does not count
    lag.Wait(now);
    now += wait;
    lag.Hear(part_bytes, now);
  }
  lag.Wait(now);
  return std::chrono::duration<double>(lag.WhileWaiting(now)).count();
}

TEST(ClientLag, ASteadySenderIsNotSilentHoweverLongItTakes) {
  EXPECT_EQ(LagSeconds(10'000, 16 << 10, 1.0), 0);
  EXPECT_EQ(LagSeconds(10'000, 1 << 20, 63.0), 0);
  EXPECT_NEAR(LagSeconds(100, 8 << 10, 1.0), 50, 1e-6) << "half as fast as it must be";
  EXPECT_NEAR(LagSeconds(100, 1, 0.01), 1, 0.01) << "a byte now and then";
}

TEST_F(MapFileCalls, AClientThatSendsAByteNowAndThenLosesItsPlace) {
  Start({}, {.import_idle_s = 0.05});
  HalfSent half(*server_, "copy", bytes_.substr(0, 20'000));
  v1::ImportMapRequest byte;  // pays off 61 us
  byte.set_data("x");
  EXPECT_TRUE(Eventually([&] { return !half.stream->Write(byte); })) << "one a millisecond at most";
  EXPECT_EQ(half.stream->Finish().error_code(), grpc::DEADLINE_EXCEEDED);
  ExpectNothingLeft("copy");
}

TEST_F(MapFileCalls, AShutdownDoesNotWaitForAnUpload) {
  HalfSent half(*server_, "copy", bytes_.substr(0, 20'000));
  ASSERT_TRUE(Eventually([&] { return NumFiles() == num_files_ + 1; }));
  ASSERT_OK(server_->Stop(/*grace_s=*/0.01));
  EXPECT_FALSE(half.stream->Finish().ok());
  EXPECT_EQ(NumFiles(), num_files_);
}

TEST_F(MapFileCalls, OneStreamUploadsOneMap) {
  HalfSent half(*server_, "copy", bytes_.substr(0, 20'000));
  v1::ImportMapRequest part;
  part.set_map_id("other");
  (void)half.stream->Write(part);
  const grpc::Status status = half.stream->Finish();
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(ReasonOf(status), "MAP_CHANGED");
  ExpectNothingLeft("copy");
}

}  // namespace
}  // namespace dhpmap::testing
