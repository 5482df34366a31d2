// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/relay/route_fields.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>
#include <grpcpp/support/proto_buffer_reader.h>

#include <cstdint>
#include <utility>

#include "dhpmap/v1/query_options.pb.h"
#include "proto/types/resource_names.h"

namespace dhpmap {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::io::CodedInputStream;
using WireFormat = google::protobuf::internal::WireFormatLite;

/// Longer names are of no map.
constexpr std::uint32_t kMostNameBytes = 1024;

bool IsText(std::uint32_t tag, int field) {
  return field != 0 && tag == WireFormat::MakeTag(field, WireFormat::WIRETYPE_LENGTH_DELIMITED);
}
bool IsNumber(std::uint32_t tag, int field) {
  return field != 0 && tag == WireFormat::MakeTag(field, WireFormat::WIRETYPE_VARINT);
}

bool ReadName(CodedInputStream& input, std::string& name) {
  std::uint32_t size = 0;
  return input.ReadVarint32(&size) && size <= kMostNameBytes && input.ReadString(&name, static_cast<int>(size));
}

int NumberOf(const FieldDescriptor* field) { return field != nullptr ? field->number() : 0; }

}  // namespace

struct RouteFields::Values {
  std::string map;
  std::uint64_t consistency = 0, read_revision = 0;
};

RouteFields::Fields RouteFields::FieldsOf(const Descriptor& message, int map) {
  const FieldDescriptor* consistency = message.FindFieldByName("consistency");
  const bool is_it = consistency != nullptr && consistency->enum_type() == v1::Consistency::Level_descriptor();
  return {.map = map,
          .consistency = is_it ? consistency->number() : 0,
          .read_revision = NumberOf(message.FindFieldByName("read_revision"))};
}

RouteFields::RouteFields(const auth::CallNeeds& needs, const Descriptor& request) {
  for (const auto& [meaning, path] : needs.fields) {
    if (meaning != v1::Access::MAP) continue;
    const bool is_inner = path.size() > 1;
    const Descriptor& message = is_inner ? *path.front()->message_type() : request;
    places_.push_back(
        {.message = is_inner ? path.front()->number() : 0, .fields = FieldsOf(message, path.back()->number())});
  }
}

bool RouteFields::Read(CodedInputStream& input, const Fields& fields, Values& values) {
  while (const std::uint32_t tag = input.ReadTag()) {
    const bool is_read = IsText(tag, fields.map)               ? ReadName(input, values.map)
                         : IsNumber(tag, fields.consistency)   ? input.ReadVarint64(&values.consistency)
                         : IsNumber(tag, fields.read_revision) ? input.ReadVarint64(&values.read_revision)
                                                               : WireFormat::SkipField(&input, tag);
    if (!is_read) return false;
  }
  return input.ConsumedEntireMessage();
}

RouteFields::Found RouteFields::In(const grpc::ByteBuffer& bytes) const {
  grpc::ByteBuffer shared = bytes;
  grpc::ProtoBufferReader reader(&shared);
  CodedInputStream input(&reader);
  Values values;
  bool is_message = true;
  if (places_.size() == 1 && places_.front().message == 0) {
    is_message = Read(input, places_.front().fields, values);
  } else {
    while (const std::uint32_t tag = is_message ? input.ReadTag() : 0) {
      const Place* found = nullptr;
      for (const Place& place : places_) found = IsText(tag, place.message) ? &place : found;
      std::uint32_t size = 0;
      if (found == nullptr) {
        is_message = WireFormat::SkipField(&input, tag);
      } else if (!input.ReadVarint32(&size) || size > INT32_MAX) {
        is_message = false;
      } else {
        values = {};  // of a oneof the last counts
        const auto limit = input.PushLimit(static_cast<int>(size));
        is_message = Read(input, found->fields, values);
        input.PopLimit(limit);
      }
    }
  }
  if (!is_message) return {};
  return {.map = MapOfResource(values.map),
          .is_eventual = values.consistency == v1::Consistency::EVENTUAL && values.read_revision == 0};
}

}  // namespace dhpmap
