// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/finish_call.h"

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <vector>

#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "dhpmap/v1/watch_service.grpc.pb.h"
#include "tests/support/assert_ok.h"
#include "tests/support/eventually.h"

namespace dhpmap {
namespace {

using testing::Eventually;

/// Says what it is told to of a map that is finished while the test wants it.
class FinishingServer final : public v1::MappingService::Service, public v1::WatchService::Service {
 public:
  explicit FinishingServer(bool takes_watchers = true) : takes_watchers_(takes_watchers) {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(static_cast<v1::MappingService::Service*>(this));
    builder.RegisterService(static_cast<v1::WatchService::Service*>(this));
    server_ = builder.BuildAndStart();
  }
  ~FinishingServer() override { server_->Shutdown(); }

  grpc::Status FinishMapping(grpc::ServerContext* context, const v1::FinishMappingRequest* request,
                             v1::FinishMappingResponse* response) override {
    EXPECT_EQ(request->map(), "maps/room");
    has_begun = true;
    Eventually([&] { return may_end || context->IsCancelled(); });
    was_cancelled = context->IsCancelled();
    has_ended = true;
    response->set_revision(7);
    return may_end ? grpc::Status::OK : grpc::Status(grpc::StatusCode::CANCELLED, "nobody waits");
  }
  grpc::Status WatchMap(grpc::ServerContext* context, const v1::WatchMapRequest* request,
                        grpc::ServerWriter<v1::WatchMapResponse>* writer) override {
    EXPECT_EQ(request->map(), "maps/room");
    if (!takes_watchers_) return {grpc::StatusCode::RESOURCE_EXHAUSTED, "too many watchers"};
    v1::WatchMapResponse message;
    message.mutable_progress()->set_revision(1);
    writer->Write(message);
    Eventually([&] { return has_begun || context->IsCancelled(); });
    for (const auto stage : {v1::FinishProgress::WAITING, v1::FinishProgress::REFINING, v1::FinishProgress::STORING}) {
      message.mutable_progress()->mutable_finishing()->set_stage(stage);
      writer->Write(message);
    }
    Eventually([&] { return context->IsCancelled(); });
    return grpc::Status::OK;
  }
  [[nodiscard]] std::shared_ptr<client::Caller> Connect() const {
    auto caller = client::Caller::Connect("127.0.0.1:" + std::to_string(port_), {});
    EXPECT_OK(caller);
    return *std::move(caller);
  }

  std::atomic<bool> has_begun = false, may_end = false, was_cancelled = false, has_ended = false;

 private:
  const bool takes_watchers_;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

TEST(FinishCall, TellsTheStagesInTheirOrder) {
  FinishingServer server;
  std::vector<v1::FinishProgress::Stage> told;
  const FinishListener listener{.on_progress =
                                    [&](const v1::FinishProgress& progress) {
                                      told.push_back(progress.stage());
                                      if (progress.stage() == v1::FinishProgress::STORING) server.may_end = true;
                                    },
                                .is_interrupted = {}};
  const auto finished = CallFinish(*server.Connect(), "maps/room", listener);
  ASSERT_OK(finished);
  EXPECT_EQ(finished->revision(), 7);
  EXPECT_EQ(told,
            (std::vector{v1::FinishProgress::WAITING, v1::FinishProgress::REFINING, v1::FinishProgress::STORING}));
}

TEST(FinishCall, IsCancelledAtTheServerWhenItIsInterrupted) {
  FinishingServer server;
  const FinishListener listener{.on_progress = [](const v1::FinishProgress&) {},
                                .is_interrupted = [&server] { return server.has_begun.load(); }};
  const auto finished = CallFinish(*server.Connect(), "maps/room", listener);
  EXPECT_EQ(finished.status().code, client::StatusCode::kCancelled);
  EXPECT_TRUE(Eventually([&] { return server.has_ended.load(); }));
  EXPECT_TRUE(server.was_cancelled);
}

TEST(FinishCall, IsMadeWhereNobodyMayWatch) {
  FinishingServer server(false);
  server.may_end = true;
  int num_told = 0;
  const FinishListener listener{.on_progress = [&](const v1::FinishProgress&) { ++num_told; }, .is_interrupted = {}};
  const auto finished = CallFinish(*server.Connect(), "maps/room", listener);
  ASSERT_OK(finished);
  EXPECT_EQ(finished->revision(), 7);
  EXPECT_EQ(num_told, 0);
}

}  // namespace
}  // namespace dhpmap
