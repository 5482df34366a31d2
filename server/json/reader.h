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

/// Dotted proto names of what a JSON text sets: its leaves, lists and maps whole; an empty object counts as itself.
using Paths = std::vector<std::string>;

/// Merges one strict JSON object into `message`, by the rules of proto3 JSON; proto names and lowerCamel names both do.
/// INVALID_ARGUMENT with the place (line, column, byte) and, for a wrong value, the field as a violation: malformed
/// text, an unknown field, a field given twice, two members of one oneof. `message` is then half-filled. `paths` may be
/// null. `ask` is asked for what the message takes as it grows: a short text may be a large one.
Status Read(std::string_view text, google::protobuf::Message* message, Paths* paths = nullptr, AskRoom ask = nullptr);

/// As Read, for the value of one field of `message`; the paths are relative to that field.
Status ReadField(std::string_view text, const google::protobuf::FieldDescriptor& field,
                 google::protobuf::Message* message, Paths* paths = nullptr, AskRoom ask = nullptr);

}  // namespace dhpmap::json
