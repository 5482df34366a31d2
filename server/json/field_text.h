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

/// Finds a field by its proto name or JSON (lowerCamel) name; null if there is none.
const google::protobuf::FieldDescriptor* FindField(const google::protobuf::Descriptor& type, std::string_view name);

/// A path from the outermost message to a field; all but the last are singular messages.
using FieldPath = std::vector<const google::protobuf::FieldDescriptor*>;

/// Resolves "submap.map_from_submap" or "submap.mapFromSubmap". INVALID_ARGUMENT names the first part that does not
/// exist.
Status ResolveFieldPath(const google::protobuf::Descriptor& type, std::string_view dotted, FieldPath* path);

/// "submap.map_from_submap", in proto names.
std::string ToString(const FieldPath& path);

/// Sets a scalar field from text: numbers, true|false, enum names or numbers, strings verbatim, bytes as base64.
/// Appends if the field is repeated. Returns the error ("expected an integer of 32 bits"), or "".
std::string SetScalarFromText(const google::protobuf::FieldDescriptor& field, std::string_view text,
                              google::protobuf::Message* message);

/// Sets the field at the end of a path, as SetScalarFromText, creating the messages on the way. Also accepts types that
/// proto3 JSON writes as one string or scalar (FieldMask, Timestamp, Duration, wrappers). INVALID_ARGUMENT names the
/// field.
Status SetFieldFromText(const FieldPath& path, std::string_view text, google::protobuf::Message* message);

/// "mapFromSubmap" and "map_from_submap" both become "map_from_submap".
std::string ToSnakeCase(std::string_view name);

/// Splits "a,b.c" and fills a google.protobuf.FieldMask with it, in proto names.
void SetFieldMask(std::string_view text, google::protobuf::Message* mask);

}  // namespace dhpmap::json
