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

/// Fields of a message that contains a file, or of the messages of a stream that carry its parts: `bytes data`, and in
/// the first message `string content_type` and optionally size and etag.
struct FileFields {
  const google::protobuf::FieldDescriptor* data;
  const google::protobuf::FieldDescriptor* content_type;
  const google::protobuf::FieldDescriptor* total_bytes;  ///< int64; null if there is none
  const google::protobuf::FieldDescriptor* etag;         ///< string; null if there is none
};

/// Fields of a stream that can be resumed: each message has a `string position`, which a request may send back as
/// `string resume_after`, and a oneof whose set field is the kind of event. Such a stream may be silent for long.
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
  const google::protobuf::FieldDescriptor* update_mask = nullptr;     ///< for PATCH: derived from the body if not given
  std::optional<FileFields> file;
  std::optional<EventFields> events;

  [[nodiscard]] bool is_stream() const;  ///< in either direction
  [[nodiscard]] bool client_streams() const;
  [[nodiscard]] bool server_streams() const;
  /// Whether the client streams the parts of a file: the body's field is bytes.
  [[nodiscard]] bool takes_file() const;
};

struct RouteMatch {
  const Route* route = nullptr;
  std::vector<std::string> values;  ///< of the path's variables
};

/// Finds the RPC of a request by google.api.http annotations. Immutable, so thread-safe.
class HttpRuleRouter {
 public:
  /// Routes for every annotated service in the generated descriptor pool. INVALID_ARGUMENT for an invalid rule
  /// (template, field), or one that matches the same requests as another.
  static Result<HttpRuleRouter> FromLinkedServices();
  static Result<HttpRuleRouter> FromServices(const std::vector<const google::protobuf::ServiceDescriptor*>& services);

  /// Returns the route and the path values; `route` is null if no route has this path and method. HEAD uses the routes
  /// of GET.
  [[nodiscard]] RouteMatch Find(std::string_view http_method, std::string_view encoded_path) const;
  /// The methods of the path, for `Allow`: "DELETE, GET, HEAD"; empty for an unknown path.
  [[nodiscard]] std::string AllowedMethods(std::string_view encoded_path) const;

  /// Most specific first.
  [[nodiscard]] const std::vector<Route>& routes() const { return routes_; }

 private:
  std::vector<Route> routes_;
};

}  // namespace dhpmap::gateway
