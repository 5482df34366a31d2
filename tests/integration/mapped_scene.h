// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "tests/integration/test_server.h"

namespace dhpmap::testing {

/// A server with "maps/room", a mapped TestScene that nobody changes: once for all tests of a suite.
class MappedScene : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { SetUpWith({}); }
  static void SetUpWith(GrpcOptions options, int num_frames = 30) {
    store_ = MakeMemoryStore();
    server_ = std::make_unique<TestServer>(*store_, SessionOptions{}, std::move(options));
    v1::CreateMapResponse created;
    grpc::ClientContext creating;
    ASSERT_TRUE(server_->maps->CreateMap(&creating, CreateRequest("room"), &created).ok());
    ASSERT_TRUE(Feed(*server_, "room", 0, num_frames).status.ok());
    v1::FinishMappingRequest finish;
    finish.set_map("maps/room");
    v1::FinishMappingResponse finished;
    grpc::ClientContext finishing;
    ASSERT_TRUE(server_->mapping->FinishMapping(&finishing, finish, &finished).ok());
  }
  static void TearDownTestSuite() {
    server_.reset();
    store_.reset();
  }

  /// The name of the one object of a class of TestScene; empty if there is not exactly one.
  static std::string ObjectOfClass(int class_id) {
    v1::ListSubmapsRequest request;
    request.set_parent("maps/room");
    request.add_class_ids(class_id);
    v1::ListSubmapsResponse response;
    grpc::ClientContext context;
    EXPECT_TRUE(server_->submaps->ListSubmaps(&context, request, &response).ok());
    return response.submaps_size() == 1 ? response.submaps(0).name() : "";
  }
  /// "field what is wrong with it", of the first violation that a google.rpc.Status tells.
  static std::string ViolationOf(const google::rpc::Status& status) {
    google::rpc::BadRequest bad;
    for (const auto& detail : status.details()) {
      if (detail.UnpackTo(&bad) && bad.field_violations_size() > 0) {
        return bad.field_violations(0).field() + " " + bad.field_violations(0).description();
      }
    }
    return "";
  }
  static std::string ViolationOf(const grpc::Status& status) {
    google::rpc::Status details;
    return details.ParseFromString(status.error_details()) ? ViolationOf(details) : "";
  }

  inline static std::unique_ptr<MapStore> store_;
  inline static std::unique_ptr<TestServer> server_;
};

}  // namespace dhpmap::testing
