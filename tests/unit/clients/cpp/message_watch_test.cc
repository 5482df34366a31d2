// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/calls/message_watch.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "dhpmap/v1/watch_service.grpc.pb.h"
#include "tests/support/assert_ok.h"
#include "tests/unit/clients/cpp/scripted_server.h"

namespace dhpmap::testing {
namespace {

using client::MessageWatch;

/// What one connection tells, by positions, and how it ends.
struct Told {
  std::vector<std::string> positions;
  grpc::StatusCode end = grpc::StatusCode::UNAVAILABLE;
};

/// Tells what the test says, a connection each.
class TellingService final : public v1::WatchService::Service {
 public:
  explicit TellingService(std::vector<Told> connections) : connections_(std::move(connections)) {}

  grpc::Status WatchMap(grpc::ServerContext*, const v1::WatchMapRequest* request,
                        grpc::ServerWriter<v1::WatchMapResponse>* writer) override {
    asked_after.push_back(request->resume_after());
    const Told told = connections_.at(asked_after.size() - 1);
    for (const std::string& position : told.positions) {
      v1::WatchMapResponse message;
      message.set_position(position);
      writer->Write(message);
    }
    return {told.end, "as the test says"};
  }

  std::vector<std::string> asked_after;  // of one connection after the other

 private:
  const std::vector<Told> connections_;
};

std::shared_ptr<client::Caller> ConnectToWatch(const std::string& address) {
  auto caller = client::Caller::Connect(address, {});
  EXPECT_OK(caller);
  return *std::move(caller);
}

client::Clock::time_point Soon() { return client::Clock::now() + std::chrono::minutes(1); }

/// All positions up to the error that ends the watch.
std::vector<std::string> ReadAll(MessageWatch& watch, client::Status& end) {
  std::vector<std::string> positions;
  while (true) {
    const auto message = watch.Next(Soon());
    end = message.status();
    if (!message.ok() || !*message) return positions;
    positions.push_back((*message)->position());
  }
}

using Positions = std::vector<std::string>;

TEST(MessageWatch, GoesOnAfterTheLastPositionThatIsOne) {
  TellingService service({{{"1-1", "1-2", ""}, grpc::StatusCode::UNAVAILABLE},
                          {{}, grpc::StatusCode::CANCELLED},
                          {{"1-3"}, grpc::StatusCode::NOT_FOUND}});
  const ScriptedServer server(service);
  std::vector<client::StatusCode> losses;
  MessageWatch watch(ConnectToWatch(server.address()), {}, 60, [&](const client::Status& why) {
    losses.push_back(why.code);
    return true;
  });
  client::Status end;
  EXPECT_EQ(ReadAll(watch, end), (Positions{"1-1", "1-2", "", "1-3"}));
  EXPECT_EQ(end.code, client::StatusCode::kNotFound) << "a map that is deleted does not come back";
  EXPECT_EQ(service.asked_after, (Positions{"", "1-2", "1-2"}));
  EXPECT_EQ(losses, (std::vector{client::StatusCode::kUnavailable, client::StatusCode::kCancelled}));
  EXPECT_EQ(watch.position(), "1-3");
}

TEST(MessageWatch, EndsWhereNobodyWantsItToGoOn) {
  TellingService service({{{"1-1"}, grpc::StatusCode::UNAVAILABLE}});
  const ScriptedServer server(service);
  MessageWatch watch(ConnectToWatch(server.address()), {}, 60, [](const client::Status&) { return false; });
  client::Status end;
  EXPECT_EQ(ReadAll(watch, end), Positions{"1-1"});
  EXPECT_EQ(end.code, client::StatusCode::kUnavailable);
  const auto after = watch.Next(Soon());
  ASSERT_OK(after);
  EXPECT_FALSE(*after) << "it is closed";
}

}  // namespace
}  // namespace dhpmap::testing
