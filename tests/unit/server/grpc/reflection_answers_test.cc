// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/reflection_answers.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <grpcpp/support/status.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "dhpmap/v1/query_service.pb.h"

namespace dhpmap {
namespace {

using grpc::reflection::v1::ServerReflectionRequest;
using grpc::reflection::v1::ServerReflectionResponse;

ServerReflectionResponse AnswerTo(const ServerReflectionRequest& request) {
  ServerReflectionResponse response;
  *response.mutable_original_request() = request;
  AnswerReflection({"a.First", "b.Second"}, response);
  EXPECT_EQ(response.original_request().SerializeAsString(), request.SerializeAsString());
  EXPECT_EQ(response.valid_host(), request.host());
  return response;
}

/// A client's pool of what came; each file must come after those that it imports, so from the last to the first.
class DescribedFiles {
 public:
  explicit DescribedFiles(const ServerReflectionResponse& response) {
    for (const std::string& bytes : response.file_descriptor_response().file_descriptor_proto()) {
      files_.emplace_back();
      EXPECT_TRUE(files_.back().ParseFromString(bytes));
    }
  }
  [[nodiscard]] std::string first() const { return files_.empty() ? "" : files_.front().name(); }
  [[nodiscard]] std::size_t size() const { return files_.size(); }

  /// Checks that each file and its imports equal the linked-in ones and arrive once.
  void ExpectWhole() const {
    google::protobuf::DescriptorPool pool;
    std::vector<const google::protobuf::FileDescriptorProto*> left;
    for (const auto& file : files_) left.push_back(&file);
    const auto is_ready = [&pool](const auto* file) {
      return std::all_of(file->dependency().begin(), file->dependency().end(),
                         [&pool](const std::string& name) { return pool.FindFileByName(name) != nullptr; });
    };
    while (!left.empty()) {
      const auto next = std::find_if(left.begin(), left.end(), is_ready);
      ASSERT_NE(next, left.end()) << "what " << left.front()->name() << " imports did not come";
      ASSERT_EQ(pool.FindFileByName((*next)->name()), nullptr) << (*next)->name() << " came twice";
      ASSERT_NE(pool.BuildFile(**next), nullptr);
      google::protobuf::FileDescriptorProto linked;
      google::protobuf::DescriptorPool::generated_pool()->FindFileByName((*next)->name())->CopyTo(&linked);
      EXPECT_EQ((*next)->SerializeAsString(), linked.SerializeAsString());
      left.erase(next);
    }
  }

 private:
  std::vector<google::protobuf::FileDescriptorProto> files_;
};

const std::string kQueryFile = "dhpmap/v1/query_service.proto";

TEST(ReflectionAnswers, ListTheServedServices) {
  ServerReflectionRequest request;
  request.set_host("here");
  request.set_list_services("*");
  const auto answer = AnswerTo(request).list_services_response();
  ASSERT_EQ(answer.service_size(), 2);
  EXPECT_EQ(answer.service(0).name(), "a.First");
  EXPECT_EQ(answer.service(1).name(), "b.Second");
}

TEST(ReflectionAnswers, DescribeAFileWithAllThatItImports) {
  (void)v1::QueryPointsRequest::descriptor();  // links the descriptors
  ServerReflectionRequest by_name;
  by_name.set_file_by_filename(kQueryFile);
  const auto answer = AnswerTo(by_name);
  const DescribedFiles files(answer);
  EXPECT_EQ(files.first(), kQueryFile);
  EXPECT_GT(files.size(), 4u);
  files.ExpectWhole();
  for (const char* symbol : {"dhpmap.v1.QueryService", "dhpmap.v1.QueryService.CastRays",
                             "dhpmap.v1.QueryPointsRequest", "dhpmap.v1.QueryPointsRequest.points_m"}) {
    ServerReflectionRequest by_symbol;
    by_symbol.set_file_containing_symbol(symbol);
    EXPECT_EQ(AnswerTo(by_symbol).file_descriptor_response().SerializeAsString(),
              answer.file_descriptor_response().SerializeAsString())
        << symbol;
  }
}

TEST(ReflectionAnswers, DescribeExtensions) {
  constexpr int kHttp = 72295728;  // google.api.http
  (void)v1::QueryPointsRequest::descriptor();
  ServerReflectionRequest all;
  all.set_all_extension_numbers_of_type("google.protobuf.MethodOptions");
  const auto answer = AnswerTo(all).all_extension_numbers_response();
  EXPECT_EQ(answer.base_type_name(), "google.protobuf.MethodOptions");
  EXPECT_EQ(std::count(answer.extension_number().begin(), answer.extension_number().end(), kHttp), 1);
  ServerReflectionRequest one;
  one.mutable_file_containing_extension()->set_containing_type("google.protobuf.MethodOptions");
  one.mutable_file_containing_extension()->set_extension_number(kHttp);
  const DescribedFiles files(AnswerTo(one));
  EXPECT_EQ(files.first(), "google/api/annotations.proto");
  files.ExpectWhole();
}

TEST(ReflectionAnswers, AreErrorsForUnknownNames) {
  std::vector<ServerReflectionRequest> unknown(6);
  unknown[0].set_file_by_filename("nowhere.proto");
  unknown[1].set_file_containing_symbol("dhpmap.v1.NoService");
  unknown[2].set_file_containing_symbol("");
  unknown[3].mutable_file_containing_extension()->set_containing_type("no.Type");
  unknown[4].mutable_file_containing_extension()->set_containing_type("google.protobuf.MethodOptions");
  unknown[4].mutable_file_containing_extension()->set_extension_number(1);
  unknown[5].set_all_extension_numbers_of_type(kQueryFile);
  for (const auto& request : unknown) {
    EXPECT_EQ(AnswerTo(request).error_response().error_code(), grpc::NOT_FOUND) << request.ShortDebugString();
  }
  EXPECT_EQ(AnswerTo({}).error_response().error_code(), grpc::INVALID_ARGUMENT);
}

}  // namespace
}  // namespace dhpmap
