// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/status.h"
#include "server/json/message_bytes.h"

namespace google::protobuf {
class FieldDescriptor;
class Message;
}  // namespace google::protobuf

namespace dhpmap::json {

/// Dotted proto names of the fields that a JSON text sets: leaves; lists and maps as a whole; an empty object as
/// itself.
using Paths = std::vector<std::string>;

/// Merges one strict JSON object into `message` by the rules of proto3 JSON; accepts proto names and lowerCamel names.
/// INVALID_ARGUMENT with the position (line, column, byte) and, for a wrong value, the field as a violation: malformed
/// text, an unknown field, a field given twice, two members of one oneof. `message` is then partly filled. `paths` may
/// be null. `ask` is asked for memory as the message grows: a short text may become a large message.
Status Read(std::string_view text, google::protobuf::Message* message, Paths* paths = nullptr, AskRoom ask = nullptr);

/// Like Read, for the value of one field of `message`; paths are relative to that field.
Status ReadField(std::string_view text, const google::protobuf::FieldDescriptor& field,
                 google::protobuf::Message* message, Paths* paths = nullptr, AskRoom ask = nullptr);

}  // namespace dhpmap::json
