// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

#include "mapping/base/status.h"

namespace dhpmap::gateway {

/// What a body is written in.
enum class BodyFormat {
  kJson,               ///< one value; for a client stream any number, each after the other (NDJSON)
  kProtobuf,           ///< one message
  kDelimitedProtobuf,  ///< each message after its length as a varint
  kFile                ///< a file, for an RPC that takes its parts
};

/// Nothing for a type that we do not take. A missing type and curl's default (a form) count as JSON.
std::optional<BodyFormat> FormatOfContentType(std::string_view content_type);

/// Whether the type is one of a file's bytes. A missing type and curl's default count as that, too.
bool IsFileType(std::string_view content_type);

/// Whether the type names one JSON value, rather than any number of them or nothing.
bool IsOneJsonValue(std::string_view content_type);

/// What the client wants to get.
enum class AnswerFormat {
  kJson,      ///< streams as NDJSON
  kProtobuf,  ///< streams as length-delimited messages
  kEvents,    ///< streams as server-sent events, all else as JSON
  kAny        ///< it named neither of them
};
AnswerFormat FormatOfAccept(std::string_view accept);

/// Whether an Accept header allows an answer of this type. One that names no type allows all.
bool IsAccepted(std::string_view accept, std::string_view type);
/// Whether it allows anything that we write messages in.
bool IsAnyFormatAccepted(std::string_view accept);
/// Reason NOT_ACCEPTABLE; `type`: what there is.
Status NotAcceptable(std::string_view accept, std::string_view type);

inline constexpr std::string_view kBytesType = "application/octet-stream";
inline constexpr std::string_view kJsonType = "application/json";
inline constexpr std::string_view kNdjsonType = "application/x-ndjson";
inline constexpr std::string_view kEventsType = "text/event-stream";
inline constexpr std::string_view kProtobufType = "application/x-protobuf";
inline constexpr std::string_view kProtobufStreamType = "application/x-protobuf-stream";

}  // namespace dhpmap::gateway
