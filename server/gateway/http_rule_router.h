// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mapping/base/result.h"
#include "server/gateway/path_template.h"
#include "server/json/field_text.h"

namespace google::protobuf {
class MethodDescriptor;
class OneofDescriptor;
class ServiceDescriptor;
}  // namespace google::protobuf

namespace dhpmap::gateway {

/// A message that holds a file, or a stream of messages that hold its parts: `bytes data`, and `string content_type`
/// (its size, and its etag) in the first.
struct FileFields {
  const google::protobuf::FieldDescriptor* data;
  const google::protobuf::FieldDescriptor* content_type;
  const google::protobuf::FieldDescriptor* total_bytes;  ///< int64; null if there is none
  const google::protobuf::FieldDescriptor* etag;         ///< string; null if there is none
};

/// A stream of messages that tell where to go on: `string position` of each, which the request may give back as
/// `string resume_after`, and one oneof, whose field that is set is the kind of event. Such a stream may be silent for
/// long.
struct EventFields {
  const google::protobuf::FieldDescriptor* position;
  const google::protobuf::OneofDescriptor* event;
  const google::protobuf::FieldDescriptor* resume_after;
};

/// One binding of an RPC to HTTP.
struct Route {
  enum class Body { kNone, kWhole, kField };

  const google::protobuf::MethodDescriptor* method = nullptr;
  std::string rpc_path;  ///< "/dhpmap.v1.MapService/GetMap"
  std::string http_method;
  PathTemplate path;
  std::vector<json::FieldPath> variables;  ///< fields of path.variables()
  Body body = Body::kNone;
  const google::protobuf::FieldDescriptor* body_field = nullptr;      ///< for kField
  const google::protobuf::FieldDescriptor* response_field = nullptr;  ///< null: the whole response is the answer
  const google::protobuf::FieldDescriptor* update_mask = nullptr;  ///< of a PATCH: derived from the body if not given
  std::optional<FileFields> file;
  std::optional<EventFields> events;

  [[nodiscard]] bool is_stream() const;  ///< in either direction
  [[nodiscard]] bool client_streams() const;
  [[nodiscard]] bool server_streams() const;
  /// The client streams the parts of a file: its body's field is bytes.
  [[nodiscard]] bool takes_file() const;
};

struct RouteMatch {
  const Route* route = nullptr;
  std::vector<std::string> values;  ///< of the path's variables
};

/// Finds the RPC of a request, from google.api.http annotations alone. Immutable, so thread-safe.
class HttpRuleRouter {
 public:
  /// Every service with annotations in the generated descriptor pool. INVALID_ARGUMENT for a rule that is wrong
  /// (template, field) or that matches the same requests as another.
  static Result<HttpRuleRouter> FromLinkedServices();
  static Result<HttpRuleRouter> FromServices(const std::vector<const google::protobuf::ServiceDescriptor*>& services);

  /// The route and path values; `route` is null if the path is unknown for this method. HEAD finds the routes of GET.
  [[nodiscard]] RouteMatch Find(std::string_view http_method, std::string_view encoded_path) const;
  /// Methods that the path has, for `Allow`: "DELETE, GET, HEAD"; empty if the path is unknown.
  [[nodiscard]] std::string AllowedMethods(std::string_view encoded_path) const;

  /// Most specific first.
  [[nodiscard]] const std::vector<Route>& routes() const { return routes_; }

 private:
  std::vector<Route> routes_;
};

}  // namespace dhpmap::gateway
