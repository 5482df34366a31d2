// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace google::protobuf {
class FieldDescriptor;
class Message;
}  // namespace google::protobuf

namespace dhpmap::json {

/// proto3 JSON with proto field names, on one line. Fields without presence are always written, so that zeros and empty
/// lists are visible; 64-bit integers are strings, bytes are base64, enums are names.
void Append(const google::protobuf::Message& message, std::string* out);

/// Writes the value of one field as Append does (null for a missing message).
void AppendField(const google::protobuf::Message& message, const google::protobuf::FieldDescriptor& field,
                 std::string* out);

/// Writes a quoted and escaped string. `text` must be UTF-8.
void AppendString(std::string_view text, std::string* out);

}  // namespace dhpmap::json
