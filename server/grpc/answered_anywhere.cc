// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/answered_anywhere.h"

#include <google/protobuf/descriptor.h>

#include "dhpmap/v1/query_options.pb.h"
#include "dhpmap/v1/watch_service.pb.h"

namespace dhpmap {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// The field `consistency`, if it has that field's type.
const FieldDescriptor* ConsistencyOf(const Descriptor& type) {
  const FieldDescriptor* field = type.FindFieldByName("consistency");
  const bool is_it = field != nullptr && field->enum_type() == v1::Consistency::Level_descriptor();
  return is_it ? field : nullptr;
}

/// The request reads a past state. Only the map's owner keeps those.
bool IsOfPast(const Message& request) {
  const FieldDescriptor* revision = request.GetDescriptor()->FindFieldByName("read_revision");
  return revision != nullptr && request.GetReflection()->GetInt64(request, revision) != 0;
}

}  // namespace

bool AnsweredAnywhere(const Message& request) {
  const Descriptor& type = *request.GetDescriptor();
  const google::protobuf::Reflection& values = *request.GetReflection();
  if (&type == v1::WatchMapRequest::descriptor()) return true;
  if (const FieldDescriptor* consistency = ConsistencyOf(type)) {
    return values.GetEnumValue(request, consistency) == v1::Consistency::EVENTUAL && !IsOfPast(request);
  }
  if (type.real_oneof_decl_count() != 1) return false;
  const FieldDescriptor* chosen = values.GetOneofFieldDescriptor(request, type.oneof_decl(0));
  const bool is_query = chosen != nullptr && chosen->message_type() != nullptr;
  return is_query && ConsistencyOf(*chosen->message_type()) != nullptr &&
         AnsweredAnywhere(values.GetMessage(request, chosen));
}

}  // namespace dhpmap
