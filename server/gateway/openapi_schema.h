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

/// Collects the types that an OpenAPI document refers to, and writes their schemas. Thread-compatible.
class OpenApiSchemas {
 public:
  /// Writes the schema of one value of the field (of an element, if it is repeated), as in JSON.
  void WriteField(const google::protobuf::FieldDescriptor& field, json::Builder* out);
  /// Writes a reference to the message's schema, or the schema of a well-known type.
  void WriteMessage(const google::protobuf::Descriptor& type, json::Builder* out);

  /// Writes the members of components/schemas: all types referred to so far, and those that they refer to.
  void WriteAll(json::Builder* out);

 private:
  void WriteValue(const google::protobuf::FieldDescriptor& field, json::Builder* out);
  void WriteDefinition(const google::protobuf::Descriptor& type, json::Builder* out);

  std::map<std::string, const google::protobuf::Descriptor*> messages_;
  std::map<std::string, const google::protobuf::EnumDescriptor*> enums_;
};

}  // namespace dhpmap::gateway
