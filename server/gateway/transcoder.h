// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "mapping/base/result.h"
#include "server/gateway/http_rule_router.h"
#include "server/gateway/media_type.h"
#include "server/http/url.h"
#include "server/json/message_bytes.h"

namespace google::protobuf {
class Descriptor;
class Message;
}  // namespace google::protobuf

namespace dhpmap::gateway {

std::unique_ptr<google::protobuf::Message> NewMessage(const google::protobuf::Descriptor& type);

/// Makes the messages of one request from its bodies, path and query. Thread-compatible.
class RequestTranscoder {
 public:
  /// INVALID_ARGUMENT for an invalid escape in query or path. `match.route` must outlive this.
  static Result<RequestTranscoder> Make(RouteMatch match, std::string_view query);

  /// Passes the header If-Match on as the etag of the RPC's request, or of its body's field. A missing header, as
  /// FindHeader returns it, or "*" sets none. INVALID_ARGUMENT if it is not one strong, non-empty entity tag, or the
  /// RPC takes no etag.
  Status SetIfMatch(std::string_view header);

  /// Passes the header Last-Event-ID on as `resume_after`, if the route has events. It overrides the URL, because a
  /// browser reconnects with the same URL.
  void SetLastEventId(std::string_view header);

  /// Sets the size of the file in the body: `total_bytes` of the request, if that field exists and is not set
  /// otherwise.
  void SetFileSize(std::uint64_t num_bytes) { file_bytes_ = num_bytes; }

  /// Converts one body, or one message of it, to the wire form of the RPC's request. Path values override the body, and
  /// query parameters fill the rest. A PATCH without update_mask gets the paths that its JSON body sets, except those
  /// in the path and the etag (a precondition, not a change). INVALID_ARGUMENT names the field or the position in the
  /// text. Asks `ask` before it allocates memory besides the body: a short body may become a large message.
  [[nodiscard]] Result<std::string> ToRequest(BodyFormat format, std::string_view body,
                                              const json::AskRoom& ask = nullptr) const;

 private:
  RequestTranscoder(RouteMatch match, http::QueryPairs query) : match_(std::move(match)), query_(std::move(query)) {}

  Status ReadBody(BodyFormat format, std::string_view body, google::protobuf::Message* request,
                  std::vector<std::string>* paths, const json::AskRoom& ask) const;
  Status ReadProtobuf(std::string_view body, google::protobuf::Message* request, const json::AskRoom& ask) const;
  Status ApplyQuery(google::protobuf::Message* request) const;
  Status ApplyPath(google::protobuf::Message* request) const;
  Status ApplyIfMatch(google::protobuf::Message* request) const;
  void ApplyFileSize(google::protobuf::Message* request) const;
  void DeriveMask(const std::vector<std::string>& paths, google::protobuf::Message* request) const;
  [[nodiscard]] Status CheckParameter(const std::string& name, const json::FieldPath& field) const;

  RouteMatch match_;
  http::QueryPairs query_;
  json::FieldPath etag_field_;
  std::string if_match_;
  std::string last_event_id_;
  std::uint64_t file_bytes_ = 0;
};

/// Converts the wire form of a response to a body. INTERNAL if it is not a message of the RPC's type.
Result<std::string> ToAnswer(const Route& route, std::string response, AnswerFormat format);

/// One message of a stream: a line {"result":...}, a length-delimited message, or a server-sent event, with the
/// position as `id` and the kind of event as name. An event without fields is a comment.
Result<std::string> ToStreamAnswer(const Route& route, std::string_view response, AnswerFormat format);

/// Appends `size` as a varint, the prefix of a length-delimited message.
void AppendVarint(std::uint64_t size, std::string* out);

}  // namespace dhpmap::gateway
