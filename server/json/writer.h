// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace google::protobuf {
class FieldDescriptor;
class Message;
}  // namespace google::protobuf

namespace dhpmap::json {

/// proto3 JSON with proto field names, in one line. Fields without presence are always written, so that a reader sees
/// the zeros and empty lists too; 64-bit integers are strings, bytes are base64, enums are names.
void Append(const google::protobuf::Message& message, std::string* out);

/// One field of a message, as Append writes its value (null for an absent message).
void AppendField(const google::protobuf::Message& message, const google::protobuf::FieldDescriptor& field,
                 std::string* out);

/// Quoted and escaped. `text` must be UTF-8.
void AppendString(std::string_view text, std::string* out);

}  // namespace dhpmap::json
