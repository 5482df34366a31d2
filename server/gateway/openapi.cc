// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/openapi.h"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <map>

#include "google/rpc/status.pb.h"
#include "server/gateway/media_type.h"
#include "server/gateway/openapi_schema.h"

namespace dhpmap::gateway {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

std::string Lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return text;
}

/// Writes one binding as an OpenAPI operation.
class OperationWriter {
 public:
  OperationWriter(const Route& route, int binding, OpenApiSchemas* schemas, json::Builder* out)
      : route_(route), binding_(binding), schemas_(*schemas), out_(*out) {}

  void Write() {
    const auto& method = *route_.method;
    out_.BeginObject();
    std::string operation = method.service()->name() + "_" + method.name();
    if (binding_ > 1) operation.append("_").append(std::to_string(binding_));
    out_.Member("operationId", operation);
    out_.Member("summary", method.full_name());
    out_.Key("tags").BeginArray().String(method.service()->name()).EndArray();
    WriteParameters();
    if (route_.body != Route::Body::kNone) WriteBody();
    WriteResponses();
    out_.EndObject();
  }

 private:
  void WriteParameters() {
    out_.Key("parameters").BeginArray();
    for (const auto& parameter : ToOpenApiPath(route_).parameters) {
      out_.BeginObject().Member("name", parameter.name).Member("in", "path").RawMember("required", "true");
      out_.Member("description", "Part of " + parameter.field + ".");
      out_.RawMember("schema", R"({"type":"string"})").EndObject();
    }
    if (route_.body != Route::Body::kWhole) {
      json::FieldPath path;
      WriteQuery(*route_.method->input_type(), &path);
    }
    out_.EndArray();
  }

  /// All fields that a query can set: scalars, their lists, and those of singular messages, a few levels deep.
  void WriteQuery(const Descriptor& type, json::FieldPath* path) {
    constexpr std::size_t kMaxDepth = 4;  // messages may be recursive
    for (int i = 0; i < type.field_count(); ++i) {
      const FieldDescriptor* field = type.field(i);
      path->push_back(field);
      const bool in_path = std::find(route_.variables.begin(), route_.variables.end(), *path) != route_.variables.end();
      const bool in_body = path->size() == 1 && field == route_.body_field;
      const Descriptor* message = field->message_type();
      const bool is_value = message == nullptr || message->well_known_type() != Descriptor::WELLKNOWNTYPE_UNSPECIFIED;
      if (!in_path && !in_body && is_value) {
        out_.BeginObject().Member("name", json::ToString(*path)).Member("in", "query").Key("schema");
        schemas_.WriteField(*field, &out_);
        out_.EndObject();
      } else if (!in_path && !in_body && !field->is_repeated() && path->size() < kMaxDepth) {
        WriteQuery(*message, path);
      }
      path->pop_back();
    }
  }

  void WriteBody() {
    out_.Key("requestBody").BeginObject().RawMember("required", "true").Key("content").BeginObject();
    if (route_.takes_file()) WriteBinary("application/octet-stream");
    out_.Key(kJsonType).BeginObject().Key("schema");
    WriteBodySchema();
    out_.EndObject();
    if (route_.client_streams() && !route_.takes_file()) {
      out_.Key(kNdjsonType).BeginObject().Key("schema");
      WriteBodySchema();
      out_.EndObject();
      WriteBinary(kProtobufStreamType);
    }
    if (!route_.takes_file()) WriteBinary(kProtobufType);
    out_.EndObject().EndObject();
  }

  void WriteBodySchema() {
    if (route_.body == Route::Body::kField) {
      schemas_.WriteField(*route_.body_field, &out_);
    } else {
      schemas_.WriteMessage(*route_.method->input_type(), &out_);
    }
  }

  void WriteBinary(std::string_view type) { out_.RawMember(type, R"({"schema":{"type":"string","format":"binary"}})"); }

  void WriteResponses() {
    out_.Key("responses").BeginObject();
    out_.Key("200").BeginObject().Member("description",
                                         route_.server_streams() ? "A stream of answers." : "The answer.");
    out_.Key("content").BeginObject();
    if (route_.file) WriteBinary("application/octet-stream");
    out_.Key(route_.server_streams() ? kNdjsonType : kJsonType).BeginObject().Key("schema");
    if (route_.server_streams()) {
      out_.BeginObject().Member("type", "object").Member("description", "One line each.");
      out_.Key("properties").BeginObject().Key("result");
      WriteAnswerSchema();
      out_.Key("error");
      schemas_.WriteMessage(*google::rpc::Status::descriptor(), &out_);
      out_.EndObject().EndObject();
    } else {
      WriteAnswerSchema();
    }
    out_.EndObject();
    WriteBinary(route_.server_streams() ? kProtobufStreamType : kProtobufType);
    if (route_.events) out_.RawMember(kEventsType, R"({"schema":{"type":"string"}})");
    out_.EndObject().EndObject();
    out_.Key("default").BeginObject().Member("description", "An error.").Key("content").BeginObject();
    out_.Key(kJsonType).BeginObject().Key("schema");
    schemas_.WriteMessage(*google::rpc::Status::descriptor(), &out_);
    out_.EndObject().EndObject().EndObject();
    out_.EndObject();
  }

  void WriteAnswerSchema() {
    if (route_.response_field != nullptr) {
      schemas_.WriteField(*route_.response_field, &out_);
    } else {
      schemas_.WriteMessage(*route_.method->output_type(), &out_);
    }
  }

  const Route& route_;
  const int binding_;
  OpenApiSchemas& schemas_;
  json::Builder& out_;
};

/// "submaps" -> "submap".
std::string Singular(const std::string& plural) {
  return plural.size() > 1 && plural.back() == 's' ? plural.substr(0, plural.size() - 1) : plural;
}

}  // namespace

OpenApiPath ToOpenApiPath(const Route& route) {
  OpenApiPath path;
  std::map<std::string, int> seen;
  const auto& segments = route.path.segments();
  for (std::size_t i = 0; i < segments.size(); ++i) {
    path.text += '/';
    if (segments[i].kind == PathTemplate::Kind::kLiteral) {
      path.text += segments[i].text;
      continue;
    }
    std::string field;
    std::string name = "part";
    for (const auto& variable : route.path.variables()) {
      if (i < variable.begin || i >= variable.end) continue;
      field = variable.field_path;
      name = variable.end == variable.begin + 1 ? variable.field_path : name;
    }
    const bool after_literal = i > 0 && segments[i - 1].kind == PathTemplate::Kind::kLiteral;
    if (after_literal && name == "part") name = Singular(segments[i - 1].text);
    if (const int count = ++seen[name]; count > 1) name += std::to_string(count);
    path.text += '{' + name + '}';
    path.parameters.push_back({std::move(name), std::move(field)});
  }
  if (!route.path.verb().empty()) path.text += ':' + route.path.verb();
  return path;
}

std::string OpenApiDocument(const HttpRuleRouter& router) {
  std::map<std::string, std::map<std::string, const Route*>> paths;
  for (const Route& route : router.routes()) paths[ToOpenApiPath(route).text].emplace(Lower(route.http_method), &route);

  OpenApiSchemas schemas;
  json::Builder out;
  out.BeginObject().Member("openapi", "3.0.3");
  out.RawMember(
      "info",
      R"({"title":"DHP Map Server","version":"v1","description":"Hierarchical panoptic maps: frames in, )"
      R"(queries out. The same RPCs are served over gRPC; 64-bit numbers are strings in JSON.","license":{"name":"BSD-3-Clause"}})");
  out.RawMember("servers", R"([{"url":"/"}])").RawMember("security", "[]");  // the server's own URL; no authentication
                                                                             // declared
  out.Key("paths").BeginObject();
  std::map<std::string, int> bindings;  // of each RPC, so that operation ids differ
  for (const auto& [path, operations] : paths) {
    out.Key(path).BeginObject();
    for (const auto& [method, route] : operations) {
      out.Key(method);
      OperationWriter(*route, ++bindings[route->method->full_name()], &schemas, &out).Write();
    }
    out.EndObject();
  }
  out.EndObject();
  out.Key("components").BeginObject().Key("schemas").BeginObject();
  schemas.WriteAll(&out);
  out.EndObject().EndObject();
  out.EndObject();
  return out.Take();
}

}  // namespace dhpmap::gateway
