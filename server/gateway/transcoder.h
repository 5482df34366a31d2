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
  /// INVALID_ARGUMENT for a broken query or path escape. `match.route` must outlive this.
  static Result<RequestTranscoder> Make(RouteMatch match, std::string_view query);

  /// The header If-Match, as the etag that the RPC's request takes, itself or in its body's field. None, as FindHeader
  /// tells it, or "*": none. INVALID_ARGUMENT if it is not one strong entity tag that is not empty, or the RPC takes
  /// none.
  Status SetIfMatch(std::string_view header);

  /// The header Last-Event-ID, as the request's `resume_after` where the route has events: it counts before the URL's,
  /// since a browser that connects again sends the same URL.
  void SetLastEventId(std::string_view header);

  /// Size of the file that the body is, where it is known: `total_bytes` of the request, if it has that and no more is
  /// said of it.
  void SetFileSize(std::uint64_t num_bytes) { file_bytes_ = num_bytes; }

  /// One body, or one message of it, as the wire form of the RPC's request. What the path says wins over the body;
  /// query parameters fill the rest; a PATCH without update_mask gets the paths that its JSON body sets, less those in
  /// the path and the etag (a precondition, not a change). INVALID_ARGUMENT names the field or the place in the text.
  /// `ask` is asked for all that is held beside the body, before it is: a short body may be a large message.
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

/// The wire form of a response as a body. INTERNAL if it is not a message of the RPC's type.
Result<std::string> ToAnswer(const Route& route, std::string response, AnswerFormat format);

/// One message of a stream: a line {"result":...}, the message after its length, or an event: with the position as its
/// `id`, and the kind of event as its name; one that has no fields is a comment.
Result<std::string> ToStreamAnswer(const Route& route, std::string_view response, AnswerFormat format);

/// The varint that goes before a message of `size` bytes.
void AppendVarint(std::uint64_t size, std::string* out);

}  // namespace dhpmap::gateway
