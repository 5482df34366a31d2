// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "server/json/builder.h"

namespace google::protobuf {
class Descriptor;
class EnumDescriptor;
class FieldDescriptor;
}  // namespace google::protobuf

namespace dhpmap::gateway {

/// Collects the types that an OpenAPI document refers to, and writes them. Thread-compatible.
class OpenApiSchemas {
 public:
  /// A schema object of one value of the field (of the list, if it is repeated), as it appears in JSON.
  void WriteField(const google::protobuf::FieldDescriptor& field, json::Builder* out);
  /// A reference to the message's schema, or what stands for a well-known type.
  void WriteMessage(const google::protobuf::Descriptor& type, json::Builder* out);

  /// The members of components/schemas: everything referred to so far, and what that refers to.
  void WriteAll(json::Builder* out);

 private:
  void WriteValue(const google::protobuf::FieldDescriptor& field, json::Builder* out);
  void WriteDefinition(const google::protobuf::Descriptor& type, json::Builder* out);

  std::map<std::string, const google::protobuf::Descriptor*> messages_;
  std::map<std::string, const google::protobuf::EnumDescriptor*> enums_;
};

}  // namespace dhpmap::gateway
