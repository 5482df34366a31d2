// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/status.h"

namespace google::protobuf {
class Descriptor;
class FieldDescriptor;
class Message;
}  // namespace google::protobuf

namespace dhpmap::json {

/// The field of that proto name or JSON (lowerCamel) name, or null.
const google::protobuf::FieldDescriptor* FindField(const google::protobuf::Descriptor& type, std::string_view name);

/// Fields from the outermost message to the one named; all but the last are singular messages.
using FieldPath = std::vector<const google::protobuf::FieldDescriptor*>;

/// "submap.map_from_submap" or "submap.mapFromSubmap". INVALID_ARGUMENT names the first part that does not exist.
Status ResolveFieldPath(const google::protobuf::Descriptor& type, std::string_view dotted, FieldPath* path);

/// "submap.map_from_submap": proto names.
std::string ToString(const FieldPath& path);

/// Sets a scalar field from its text: numbers, true|false, enum names or numbers, strings as they are, bytes as base64.
/// Appends if the field is repeated. Returns what is wrong ("expected an integer of 32 bits"), or "".
std::string SetScalarFromText(const google::protobuf::FieldDescriptor& field, std::string_view text,
                              google::protobuf::Message* message);

/// As SetScalarFromText at the end of a path, making the messages on the way; also takes what proto3 JSON writes as one
/// string or scalar (FieldMask, Timestamp, Duration, wrappers). INVALID_ARGUMENT names the field.
Status SetFieldFromText(const FieldPath& path, std::string_view text, google::protobuf::Message* message);

/// "mapFromSubmap" and "map_from_submap" both become "map_from_submap".
std::string ToSnakeCase(std::string_view name);

/// Splits "a,b.c" and fills a google.protobuf.FieldMask with it, in proto names.
void SetFieldMask(std::string_view text, google::protobuf::Message* mask);

}  // namespace dhpmap::json
