// SPDX-License-Identifier: BSD-3-Clause
// What the bytes of a request say of its way is what the parsed message says, of all rpcs that there are.
#include "server/grpc/relay/route_fields.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "dhpmap/v1/query_service.pb.h"
#include "server/auth/rights.h"
#include "server/grpc/answered_anywhere.h"

namespace dhpmap {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::DescriptorPool;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::MessageFactory;

grpc::ByteBuffer BytesOf(const std::string& text) {
  const grpc::Slice slice(text);
  return {&slice, 1};
}

struct Method {
  std::string path;
  const auth::CallNeeds* needs;
  const Descriptor* request;
};

/// Methods whose requests name a map.
std::vector<Method> Methods(const auth::CallTable& table) {
  std::vector<Method> methods;
  for (const auto& [path, needs] : table.calls()) {
    if (!path.starts_with("/dhpmap.v1.")) continue;
    std::string name = path.substr(1);
    name[name.find('/')] = '.';
    const Descriptor* request = DescriptorPool::generated_pool()->FindMethodByName(name)->input_type();
    if (!RouteFields(needs, *request).empty()) methods.push_back({path, &needs, request});
  }
  return methods;
}

/// A request that names `map` in the field of `path`, with these beside it where there are such fields.
std::unique_ptr<Message> RequestOf(const Method& method, const auth::FieldPath& path, const std::string& map,
                                   int consistency, int read_revision) {
  std::unique_ptr<Message> request(MessageFactory::generated_factory()->GetPrototype(method.request)->New());
  Message* holder = request.get();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) holder = holder->GetReflection()->MutableMessage(holder, path[i]);
  const auto& values = *holder->GetReflection();
  values.SetString(holder, path.back(), map);
  const Descriptor& type = *holder->GetDescriptor();
  if (const auto* field = type.FindFieldByName("consistency")) values.SetEnumValue(holder, field, consistency);
  if (const auto* field = type.FindFieldByName("read_revision")) values.SetInt64(holder, field, read_revision);
  return request;
}

TEST(RouteFields, AgreeWithTheParsedMessage) {
  const auto table = auth::CallTable::OfLinkedServices();
  ASSERT_TRUE(table.ok());
  int num_eventual = 0;
  for (const Method& method : Methods(*table)) {
    const RouteFields fields(*method.needs, *method.request);
    for (const auto& [meaning, path] : method.needs->fields) {
      if (meaning != v1::Access::MAP) continue;
      for (const std::string& name :
           {std::string("maps/hall"), std::string("maps/hall/submaps/3"), std::string("x"), std::string()}) {
        for (const int consistency : {0, 1, 7}) {
          for (const int read_revision : {0, 5}) {
            const auto request = RequestOf(method, path, name, consistency, read_revision);
            const RouteFields::Found found = fields.In(BytesOf(request->SerializeAsString()));
            EXPECT_EQ(found.map, auth::MapNamed(*method.needs, *request)) << method.path;
            const bool is_watch = method.path.ends_with("/WatchMap");  // which is never passed on, whatever it says
            EXPECT_EQ(found.is_eventual || is_watch, AnsweredAnywhere(*request)) << method.path;
            num_eventual += found.is_eventual ? 1 : 0;
          }
        }
      }
    }
  }
  EXPECT_GT(num_eventual, 0);
}

TEST(RouteFields, UseTheLastOfRepeatedFields) {
  const auto table = auth::CallTable::OfLinkedServices();
  const std::string path = "/dhpmap.v1.QueryService/StreamQueries";
  const RouteFields fields(*table->Find(path), *v1::StreamQueriesRequest::descriptor());
  v1::StreamQueriesRequest a, b;
  a.mutable_query_points()->set_map("maps/a");
  a.mutable_query_points()->set_consistency(v1::Consistency::EVENTUAL);
  b.mutable_cast_rays()->set_map("maps/b");
  const RouteFields::Found found = fields.In(BytesOf(a.SerializeAsString() + b.SerializeAsString()));
  EXPECT_EQ(found.map, "b");
  EXPECT_FALSE(found.is_eventual);
}

TEST(RouteFields, FindNothingInMalformedBytes) {
  const auto table = auth::CallTable::OfLinkedServices();
  const std::string path = "/dhpmap.v1.QueryService/QueryPoints";
  const RouteFields fields(*table->Find(path), *v1::QueryPointsRequest::descriptor());
  v1::QueryPointsRequest request;
  request.set_map("maps/" + std::string(40, 'a'));
  const std::string whole = request.SerializeAsString();
  for (std::size_t size = 1; size < whole.size(); ++size) {
    EXPECT_EQ(fields.In(BytesOf(whole.substr(0, size))).map, "") << size;
  }
  request.set_map("maps/" + std::string(5000, 'a'));
  EXPECT_EQ(fields.In(BytesOf(request.SerializeAsString())).map, "") << "no map has so long a name";
  EXPECT_EQ(fields.In(grpc::ByteBuffer()).map, "");
}

}  // namespace
}  // namespace dhpmap
