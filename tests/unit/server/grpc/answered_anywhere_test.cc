// SPDX-License-Identifier: BSD-3-Clause
// Over all rpcs that there are, so that a new one cannot be forgotten: what reads the past can be read anywhere, too.
#include "server/grpc/answered_anywhere.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "dhpmap/v1/query_service.pb.h"
#include "dhpmap/v1/watch_service.pb.h"
#include "server/auth/call_needs.h"

namespace dhpmap {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::DescriptorPool;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::MessageFactory;
using google::protobuf::MethodDescriptor;

std::unique_ptr<Message> New(const Descriptor& type) {
  return std::unique_ptr<Message>(MessageFactory::generated_factory()->GetPrototype(&type)->New());
}

std::vector<const MethodDescriptor*> AllMethods() {
  std::vector<const MethodDescriptor*> methods;
  const auto table = auth::CallTable::OfLinkedServices();
  if (!table.ok()) return methods;
  for (const auto& entry : table->calls()) {
    const std::string path = entry.first.substr(1);
    const std::size_t slash = path.find('/');
    const auto* service = DescriptorPool::generated_pool()->FindServiceByName(path.substr(0, slash));
    if (service == nullptr || service->file()->package() != "dhpmap.v1") continue;
    methods.push_back(service->FindMethodByName(path.substr(slash + 1)));
  }
  return methods;
}

/// Requests about one state of a map: those of the calls, and those in a stream's messages.
std::vector<const Descriptor*> ReadsOf(const Descriptor& request) {
  if (request.FindFieldByName("read_revision") != nullptr) return {&request};
  std::vector<const Descriptor*> reads;
  for (int i = 0; request.real_oneof_decl_count() > 0 && i < request.oneof_decl(0)->field_count(); ++i) {
    const Descriptor* query = request.oneof_decl(0)->field(i)->message_type();
    if (query != nullptr && query->FindFieldByName("read_revision") != nullptr) reads.push_back(query);
  }
  return reads;
}

void SetNumber(Message& message, const char* name, std::int64_t number) {
  const FieldDescriptor* field = message.GetDescriptor()->FindFieldByName(name);
  ASSERT_NE(field, nullptr) << message.GetTypeName() << " has no " << name;
  if (field->enum_type() != nullptr) message.GetReflection()->SetEnumValue(&message, field, static_cast<int>(number));
  else message.GetReflection()->SetInt64(&message, field, number);
}

TEST(AnsweredAnywhere, IsOnlyAWatchByDefault) {
  ASSERT_GT(AllMethods().size(), 30u);
  for (const MethodDescriptor* method : AllMethods()) {
    const bool is_watch = method->input_type() == v1::WatchMapRequest::descriptor();
    EXPECT_EQ(AnsweredAnywhere(*New(*method->input_type())), is_watch) << method->full_name();
  }
}

TEST(AnsweredAnywhere, IsEveryEventualReadOfAMap) {
  int num_reads = 0;
  for (const MethodDescriptor* method : AllMethods()) {
    for (const Descriptor* type : ReadsOf(*method->input_type())) {
      ++num_reads;
      const auto request = New(*type);
      SetNumber(*request, "consistency", v1::Consistency::EVENTUAL);
      EXPECT_TRUE(AnsweredAnywhere(*request)) << type->full_name();
      SetNumber(*request, "read_revision", 3);
      EXPECT_FALSE(AnsweredAnywhere(*request)) << type->full_name() << ": past states are the owner's";
    }
  }
  EXPECT_GT(num_reads, 15);
}

TEST(AnsweredAnywhere, IsAStreamWithAnEventualQuery) {
  v1::StreamQueriesRequest message;
  EXPECT_FALSE(AnsweredAnywhere(message)) << "no query";
  message.mutable_query_points()->set_map("maps/room");
  EXPECT_FALSE(AnsweredAnywhere(message));
  message.mutable_query_points()->set_consistency(v1::Consistency::EVENTUAL);
  EXPECT_TRUE(AnsweredAnywhere(message));
  message.mutable_pin()->set_map("maps/room");
  EXPECT_FALSE(AnsweredAnywhere(message)) << "another query is set now";
  message.mutable_pin()->set_consistency(v1::Consistency::EVENTUAL);
  EXPECT_TRUE(AnsweredAnywhere(message));
}

}  // namespace
}  // namespace dhpmap
