// SPDX-License-Identifier: BSD-3-Clause
// Deadlines, repetitions, tokens: what a scripted server sees of the C++ client.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>

#include "dhpmap/client.h"
#include "dhpmap/v1/edit_service.grpc.pb.h"
#include "dhpmap/v1/map_service.grpc.pb.h"
#include "dhpmap/v1/query_service.grpc.pb.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "tests/support/assert_ok.h"
#include "tests/support/scenes.h"
#include "tests/unit/clients/cpp/certificates.h"
#include "tests/unit/clients/cpp/scripted_server.h"

namespace dhpmap::testing {
namespace {

grpc::Status Away() { return {grpc::StatusCode::UNAVAILABLE, "away"}; }

/// Is away for the first calls of each method.
class ScriptedMaps final : public v1::MapService::Service {
 public:
  std::atomic<int> num_away = 0, num_calls = 0;
  grpc::Status failure = Away();
  std::string token;

 private:
  grpc::Status GetMap(grpc::ServerContext* context, const v1::GetMapRequest* request,
                      v1::GetMapResponse* response) override {
    const auto& metadata = context->client_metadata();
    if (const auto its = metadata.find("authorization"); its != metadata.end()) {
      token.assign(its->second.data(), its->second.size());
    }
    response->mutable_map()->set_name(request->name());
    return ++num_calls <= num_away ? failure : grpc::Status::OK;
  }
  grpc::Status CreateMap(grpc::ServerContext*, const v1::CreateMapRequest*, v1::CreateMapResponse*) override {
    return ++num_calls <= num_away ? failure : grpc::Status::OK;
  }
};

class ScriptedEdits final : public v1::EditService::Service {
 public:
  std::vector<std::string> request_ids;

 private:
  grpc::Status ApplyEdits(grpc::ServerContext*, const v1::ApplyEditsRequest* request,
                          v1::ApplyEditsResponse* response) override {
    request_ids.push_back(request->request_id());
    response->set_revision(7);
    return request_ids.size() < 3 ? Away() : grpc::Status::OK;
  }
};

/// Each of its streams answers so many queries before it is lost.
class ScriptedQueries final : public v1::QueryService::Service {
 public:
  std::atomic<int> answers_a_stream = 2;
  std::atomic<int> num_streams = 0;
  std::vector<std::int64_t> pinned;
  std::atomic<bool> is_pin_old = false;  ///< refuses queries until the next pin
  std::vector<v1::Consistency::Level> relations_of;

 private:
  grpc::Status QueryRelations(grpc::ServerContext*, const v1::QueryRelationsRequest* request,
                              v1::QueryRelationsResponse*) override {
    relations_of.push_back(request->consistency());
    return grpc::Status::OK;
  }
  grpc::Status StreamQueries(
      grpc::ServerContext*,
      grpc::ServerReaderWriter<v1::StreamQueriesResponse, v1::StreamQueriesRequest>* stream) override {
    ++num_streams;
    v1::StreamQueriesRequest request;
    for (int i = 0; i < answers_a_stream && stream->Read(&request); ++i) {
      v1::StreamQueriesResponse response;
      response.set_sequence(request.sequence());
      if (request.has_pin()) {
        pinned.push_back(request.pin().read_revision());
        response.mutable_pin()->set_revision(5);
        is_pin_old = false;
      } else if (is_pin_old) {
        google::rpc::BadRequest bad;
        bad.add_field_violations()->set_field("pin");
        response.mutable_error()->set_code(grpc::StatusCode::FAILED_PRECONDITION);
        response.mutable_error()->add_details()->PackFrom(bad);
      } else {
        response.mutable_search_submaps()->set_revision(5);
      }
      stream->Write(response);
    }
    return Away();
  }
};

struct Scripted {
  ScriptedMaps maps;
  ScriptedEdits edits;
  ScriptedQueries queries;
  ScriptedServer<ScriptedMaps, ScriptedEdits, ScriptedQueries> server{maps, edits, queries};

  client::Client Connect(client::ConnectOptions options = {}) const {
    auto connected = client::Client::Connect(server.address(), options);
    EXPECT_OK(connected);
    return *std::move(connected);
  }
};

TEST(ClientCalls, ACallIsSentAgainWhileTheServerIsAway) {
  Scripted scripted;
  scripted.maps.num_away = 2;
  ASSERT_OK(scripted.Connect().OpenMap("room"));
  EXPECT_EQ(scripted.maps.num_calls, 3);
}

TEST(ClientCalls, NoCallIsSentAgainAfterItsDeadline) {
  Scripted scripted;
  scripted.maps.num_away = 1000;
  const auto away = scripted.Connect({.deadline_s = 0.25}).OpenMap("room");
  EXPECT_EQ(away.status().code, client::StatusCode::kUnavailable);
  EXPECT_NE(away.status().message.find(scripted.server.address()), std::string::npos) << away.status().ToString();
  EXPECT_LE(scripted.maps.num_calls, 2);  // 0.1 s and 0.2 s between them
}

TEST(ClientCalls, AnEventualMapTakesAnyStateOfTheServer) {
  Scripted scripted;
  const auto map = *scripted.Connect().OpenMap("room");
  EXPECT_OK(map.Relations());
  EXPECT_OK(map.Eventual().Relations());
  EXPECT_EQ(scripted.queries.relations_of,
            (std::vector{v1::Consistency::LEVEL_UNSPECIFIED, v1::Consistency::EVENTUAL}));
}

TEST(ClientCalls, ACreationIsNeverSentTwice) {
  Scripted scripted;
  scripted.maps.num_away = 1;
  EXPECT_EQ(scripted.Connect().CreateMap("room").status().code, client::StatusCode::kUnavailable);
  EXPECT_EQ(scripted.maps.num_calls, 1);
}

TEST(ClientCalls, AnEditThatIsSentAgainKeepsItsRequestId) {
  Scripted scripted;
  const client::Map room = *scripted.Connect().OpenMap("room");
  client::Edit edit = room.Edit();
  ASSERT_OK_AND_ASSIGN(const auto edited, edit.Delete(3).Apply());
  EXPECT_EQ(edited.revision, 7);
  ASSERT_EQ(scripted.edits.request_ids.size(), 3);
  const std::string first = scripted.edits.request_ids[0];
  EXPECT_EQ(first.size(), 36);
  EXPECT_EQ(first[14], '4');
  EXPECT_EQ(std::count(scripted.edits.request_ids.begin(), scripted.edits.request_ids.end(), first), 3);

  client::Edit other = room.Edit();
  ASSERT_OK(other.Delete(3).Apply());
  EXPECT_NE(scripted.edits.request_ids.back(), first);
}

TEST(ClientCalls, AnErrorHasItsReasonViolationsAndMetadata) {
  google::rpc::Status told;
  told.set_code(grpc::StatusCode::NOT_FOUND);
  google::rpc::ErrorInfo info;
  info.set_reason("OF_A_NEWER_SERVER");
  (*info.mutable_metadata())["merged_into"] = "maps/room/submaps/7";
  told.add_details()->PackFrom(info);
  google::rpc::BadRequest bad;
  bad.add_field_violations()->set_field("name");
  told.add_details()->PackFrom(bad);
  Scripted scripted;
  scripted.maps.failure = {grpc::StatusCode::NOT_FOUND, "gone", told.SerializeAsString()};
  scripted.maps.num_away = 1;
  const client::Status status = scripted.Connect().OpenMap("room").status();
  EXPECT_EQ(status.code, client::StatusCode::kNotFound);
  EXPECT_EQ(status.reason, "OF_A_NEWER_SERVER");
  EXPECT_EQ(status.metadata.at("merged_into"), "maps/room/submaps/7");
  ASSERT_EQ(status.violations.size(), 1);
  EXPECT_EQ(status.violations[0].field, "name");
  EXPECT_EQ(status.ToString(), "NOT_FOUND: gone (OF_A_NEWER_SERVER)");
}

TEST(ClientCalls, AResultThrowsItsStatusOnlyIfItIsAskedSo) {
  const client::Result<int> none(client::Status{client::StatusCode::kNotFound, "no sofa", {}, {}, {}});
  EXPECT_FALSE(none.ok());
  try {
    (void)none.value();
    FAIL() << "there is a value";
  } catch (const client::BadResult& bad) {
    EXPECT_STREQ(bad.what(), "NOT_FOUND: no sofa");
    EXPECT_EQ(bad.status().code, client::StatusCode::kNotFound);
  }
  EXPECT_EQ(client::Result<int>(7).value(), 7);
  EXPECT_EQ(client::Result<int>(client::Status{}).status().code, client::StatusCode::kInternal);
}

TEST(ClientCalls, ATokenGoesToThisMachineAndNowhereElseInTheClear) {
  Scripted scripted;
  ASSERT_OK(scripted.Connect({.token = "secret"}).OpenMap("room"));
  EXPECT_EQ(scripted.maps.token, "Bearer secret");
  const auto elsewhere = client::Client::Connect("192.0.2.1:50051", {.connect_s = 0.01, .token = "secret"});
  EXPECT_EQ(elsewhere.status().code, client::StatusCode::kInvalidArgument);
  EXPECT_EQ(elsewhere.status().message.find("secret"), std::string::npos);
}

TEST(ClientCalls, ATokenIsReadFromAFileThatNobodyElseMayRead) {
  const TempDir dir;
  const auto file = dir.path() / "key";
  std::ofstream(file) << "secret\n";
  std::filesystem::permissions(file, std::filesystem::perms::owner_read);
  Scripted scripted;
  ASSERT_OK(scripted.Connect({.token_file = file.string()}).OpenMap("room"));
  EXPECT_EQ(scripted.maps.token, "Bearer secret");
  const auto code_of = [&](const client::ConnectOptions& options) {
    return client::Client::Connect(scripted.server.address(), options).status().code;
  };
  EXPECT_EQ(code_of({.token = "another", .token_file = file.string()}), client::StatusCode::kInvalidArgument);
  EXPECT_EQ(code_of({.token_file = "/nowhere/key"}), client::StatusCode::kInvalidArgument);
  std::filesystem::permissions(file, std::filesystem::perms::owner_read | std::filesystem::perms::group_read);
  EXPECT_EQ(code_of({.token_file = file.string()}), client::StatusCode::kInvalidArgument);
}

TEST(ClientCalls, WhatCannotBeConnectedToIsTold) {
  const auto nobody = client::Client::Connect("127.0.0.1:1", {.connect_s = 0.1});
  EXPECT_EQ(nobody.status().code, client::StatusCode::kUnavailable);
  EXPECT_NE(nobody.status().message.find("127.0.0.1:1"), std::string::npos);
  const auto no_file = client::Client::Connect("127.0.0.1:1", {.ca_file = "/nowhere/ca.pem"});
  EXPECT_EQ(no_file.status().code, client::StatusCode::kInvalidArgument);
  EXPECT_NE(no_file.status().message.find("/nowhere/ca.pem"), std::string::npos);
}

TEST(ClientCalls, ALoopGoesOnOverANewStreamPinnedAsBefore) {
  Scripted scripted;
  client::Loop loop = scripted.Connect().OpenMap("room")->Loop();
  ASSERT_OK_AND_ASSIGN(const auto revision, loop.Pin());
  EXPECT_EQ(revision, 5);
  for (int i = 0; i < 3; ++i) ASSERT_OK(loop.Find("sofa"));
  // Two answers a stream: pin and query; from then on the pin again and a query.
  EXPECT_EQ(scripted.queries.num_streams, 3);
  EXPECT_EQ(scripted.queries.pinned, (std::vector<std::int64_t>{0, 5, 5}));
}

TEST(ClientCalls, APinThatTheServerHasLetGoIsRenewedByAPinnedAndToldByALoop) {
  Scripted scripted;
  scripted.queries.answers_a_stream = 100;
  const client::Map room = *scripted.Connect().OpenMap("room");
  ASSERT_OK_AND_ASSIGN(const auto pinned, room.Pin());
  scripted.queries.is_pin_old = true;
  ASSERT_OK(pinned.Find("sofa"));
  EXPECT_EQ(scripted.queries.pinned, (std::vector<std::int64_t>{0, 5}));

  client::Loop loop = room.Loop();
  ASSERT_OK(loop.Pin());
  scripted.queries.is_pin_old = true;
  EXPECT_EQ(loop.Find("sofa").status().code, client::StatusCode::kFailedPrecondition);
  ASSERT_OK(loop.Pin());
  ASSERT_OK(loop.Find("sofa"));
}

TEST(ClientCalls, CertificatesInAFileMakeTheConnectionOneOverTls) {
  const TempDir dir;
  const auto own = (dir.path() / "own.pem").string(), other = (dir.path() / "other.pem").string();
  std::ofstream(own) << kOwnCertificate;
  std::ofstream(other) << kOtherCertificate;
  grpc::SslServerCredentialsOptions ssl;
  ssl.pem_key_cert_pairs.push_back({kOwnKey, kOwnCertificate});
  ScriptedMaps maps;
  const ScriptedServer<ScriptedMaps> server(grpc::SslServerCredentials(ssl), maps);
  const auto connected = client::Client::Connect(server.address(), {.ca_file = own, .token = "secret"});
  ASSERT_OK(connected);
  ASSERT_OK(connected->OpenMap("room"));
  EXPECT_EQ(maps.token, "Bearer secret");
  EXPECT_EQ(client::Client::Connect(server.address(), {.connect_s = 0.3, .ca_file = other}).status().code,
            client::StatusCode::kUnavailable);
  EXPECT_EQ(client::Client::Connect(server.address(), {.connect_s = 0.3}).status().code,
            client::StatusCode::kUnavailable);
}

}  // namespace
}  // namespace dhpmap::testing
