// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "tests/integration/test_server.h"

namespace dhpmap::testing {

/// A server with "maps/room", a mapped TestScene that no test changes: shared by all tests of a suite.
class MappedScene : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { SetUpWith({}); }
  static void SetUpWith(GrpcOptions options, int num_frames = 30) {
    store_ = MakeMemoryStore();
    server_ = std::make_unique<TestServer>(*store_, OpenMapOptions{}, std::move(options));
    ASSERT_OK(server_->Call(&MapStub::CreateMap, CreateRequest("room")));
    ASSERT_OK(Feed(*server_, "room", 0, num_frames));
    ASSERT_OK(server_->Call(&MappingStub::FinishMapping, "maps/room"));
  }
  static void TearDownTestSuite() {
    server_.reset();
    store_.reset();
  }

  /// The name of the only object of a class of TestScene; empty if there is not exactly one.
  static std::string ObjectOfClass(int class_id) {
    v1::ListSubmapsRequest request;
    request.set_parent("maps/room");
    request.add_class_ids(class_id);
    const auto response = server_->Call(&SubmapStub::ListSubmaps, request).value();
    return response.submaps_size() == 1 ? response.submaps(0).name() : "";
  }

  inline static std::unique_ptr<MapStore> store_;
  inline static std::unique_ptr<TestServer> server_;
};

}  // namespace dhpmap::testing
