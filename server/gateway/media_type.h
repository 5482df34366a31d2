// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

#include "mapping/base/status.h"

namespace dhpmap::gateway {

/// Format of a request body.
enum class BodyFormat {
  kJson,               ///< one value; for a client stream any number of values in a row (NDJSON)
  kProtobuf,           ///< one message
  kDelimitedProtobuf,  ///< each message preceded by its length as a varint
  kFile                ///< a file, for an RPC that receives its parts
};

/// Nothing for an unsupported type. A missing type and curl's default (a form) count as JSON.
std::optional<BodyFormat> FormatOfContentType(std::string_view content_type);

/// Whether the type stands for the bytes of a file. A missing type and curl's default count, too.
bool IsFileType(std::string_view content_type);

/// Whether the type stands for one JSON value: not for NDJSON, and not if it is missing.
bool IsOneJsonValue(std::string_view content_type);

/// The answer format that the client asks for.
enum class AnswerFormat {
  kJson,      ///< streams as NDJSON
  kProtobuf,  ///< streams as length-delimited messages
  kEvents,    ///< streams as server-sent events, everything else as JSON
  kAny        ///< none of these is named
};
AnswerFormat FormatOfAccept(std::string_view accept);

/// Whether an Accept header allows this type. A header without types allows all.
bool IsAccepted(std::string_view accept, std::string_view type);
/// Whether it allows any format of messages.
bool IsAnyFormatAccepted(std::string_view accept);
/// Reason NOT_ACCEPTABLE; `type`: the available type.
Status NotAcceptable(std::string_view accept, std::string_view type);

inline constexpr std::string_view kBytesType = "application/octet-stream";
inline constexpr std::string_view kJsonType = "application/json";
inline constexpr std::string_view kNdjsonType = "application/x-ndjson";
inline constexpr std::string_view kEventsType = "text/event-stream";
inline constexpr std::string_view kProtobufType = "application/x-protobuf";
inline constexpr std::string_view kProtobufStreamType = "application/x-protobuf-stream";

}  // namespace dhpmap::gateway
