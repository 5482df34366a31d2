// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/http_rule_router.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor_database.h>

#include <algorithm>
#include <set>

#include "google/api/annotations.pb.h"
#include "server/gateway/linked_protos.h"

namespace dhpmap::gateway {
namespace {

using google::api::HttpRule;
using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::MethodDescriptor;
using google::protobuf::ServiceDescriptor;

std::pair<std::string, std::string> MethodAndPath(const HttpRule& rule) {
  switch (rule.pattern_case()) {
    case HttpRule::kGet: return {"GET", rule.get()};
    case HttpRule::kPut: return {"PUT", rule.put()};
    case HttpRule::kPost: return {"POST", rule.post()};
    case HttpRule::kDelete: return {"DELETE", rule.delete_()};
    case HttpRule::kPatch: return {"PATCH", rule.patch()};
    case HttpRule::kCustom: return {rule.custom().kind(), rule.custom().path()};
    case HttpRule::PATTERN_NOT_SET: break;
  }
  return {};
}

const FieldDescriptor* FindText(const Descriptor& type, const char* name) {
  const auto* field = type.FindFieldByName(name);
  const bool is_text = field != nullptr && field->type() == FieldDescriptor::TYPE_STRING && !field->is_repeated();
  return is_text ? field : nullptr;
}

std::optional<FileFields> FindFileFields(const MethodDescriptor& method) {
  const Descriptor& type = *method.output_type();
  const auto* data = type.FindFieldByName("data");
  const auto* content_type = type.FindFieldByName("content_type");
  const auto* total = type.FindFieldByName("total_bytes");
  if (data == nullptr || data->type() != FieldDescriptor::TYPE_BYTES || data->is_repeated()) return std::nullopt;
  if (content_type == nullptr || content_type->type() != FieldDescriptor::TYPE_STRING || content_type->is_repeated()) {
    return std::nullopt;
  }
  if (total != nullptr && (total->cpp_type() != FieldDescriptor::CPPTYPE_INT64 || total->is_repeated()))
    total = nullptr;
  return FileFields{data, content_type, total, FindText(type, "etag")};
}

std::optional<EventFields> FindEventFields(const MethodDescriptor& method) {
  const Descriptor& type = *method.output_type();
  const auto* position = FindText(type, "position");
  const auto* resume_after = FindText(*method.input_type(), "resume_after");
  const bool has_all = method.server_streaming() && !method.client_streaming() && position != nullptr &&
                       resume_after != nullptr && type.real_oneof_decl_count() == 1;
  if (!has_all) return std::nullopt;
  return EventFields{position, type.oneof_decl(0), resume_after};
}

const FieldDescriptor* FindUpdateMask(const MethodDescriptor& method) {
  const auto* field = method.input_type()->FindFieldByName("update_mask");
  const bool is_mask = field != nullptr && field->message_type() != nullptr && !field->is_repeated() &&
                       field->message_type()->full_name() == "google.protobuf.FieldMask";
  return is_mask ? field : nullptr;
}

Status Wrong(const MethodDescriptor& method, const std::string& what) {
  return InvalidArgument("google.api.http of " + method.full_name() + ": " + what);
}

Status BindBody(const HttpRule& rule, Route* route) {
  const MethodDescriptor& method = *route->method;
  if (rule.body() == "*") {
    route->body = Route::Body::kWhole;
  } else if (!rule.body().empty()) {
    route->body = Route::Body::kField;
    route->body_field = method.input_type()->FindFieldByName(rule.body());
    if (route->body_field == nullptr) return Wrong(method, "no field '" + rule.body() + "' for the body");
  }
  if (!rule.response_body().empty()) {
    route->response_field = method.output_type()->FindFieldByName(rule.response_body());
    if (route->response_field == nullptr)
      return Wrong(method, "no field '" + rule.response_body() + "' to answer with");
  }
  if (route->http_method == "PATCH") route->update_mask = FindUpdateMask(method);
  return Status::Ok();
}

Result<Route> MakeRoute(const MethodDescriptor& method, const HttpRule& rule) {
  auto [http_method, path] = MethodAndPath(rule);
  if (path.empty()) return Wrong(method, "no path");
  auto parsed = PathTemplate::Parse(path);
  if (!parsed.ok()) return Wrong(method, parsed.status().message());
  Route route;
  route.method = &method;
  route.rpc_path = "/" + method.service()->full_name() + "/" + method.name();
  route.http_method = std::move(http_method);
  route.path = std::move(*parsed);
  route.file = FindFileFields(method);
  route.events = FindEventFields(method);
  for (const auto& variable : route.path.variables()) {
    json::FieldPath fields;
    Status found = json::ResolveFieldPath(*method.input_type(), variable.field_path, &fields);
    if (!found.ok()) return Wrong(method, found.message());
    const bool scalar = fields.back()->message_type() == nullptr && !fields.back()->is_repeated();
    if (!scalar) return Wrong(method, "'" + variable.field_path + "' cannot be in a path: it is no single value");
    route.variables.push_back(std::move(fields));
  }
  DHPMAP_RETURN_IF_ERROR(BindBody(rule, &route));
  return route;
}

Status AddRoutes(const MethodDescriptor& method, std::vector<Route>* routes) {
  if (!method.options().HasExtension(google::api::http)) return Status::Ok();
  const HttpRule& rule = method.options().GetExtension(google::api::http);
  DHPMAP_ASSIGN_OR_RETURN(Route first, MakeRoute(method, rule));
  routes->push_back(std::move(first));
  for (const HttpRule& more : rule.additional_bindings()) {
    DHPMAP_ASSIGN_OR_RETURN(Route route, MakeRoute(method, more));
    routes->push_back(std::move(route));
  }
  return Status::Ok();
}

/// Orders templates by segment: literals before "*" before "**". So the most specific of the templates that match a
/// path is found first.
bool MoreSpecific(const Route& a, const Route& b) {
  const auto& left = a.path.segments();
  const auto& right = b.path.segments();
  for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i) {
    if (left[i].kind != right[i].kind) return left[i].kind < right[i].kind;
  }
  return left.size() > right.size();
}

}  // namespace

bool Route::client_streams() const { return method->client_streaming(); }
bool Route::server_streams() const { return method->server_streaming(); }
bool Route::takes_file() const {
  return client_streams() && body == Body::kField && body_field->type() == FieldDescriptor::TYPE_BYTES &&
         !body_field->is_repeated();
}
bool Route::is_stream() const { return method->client_streaming() || method->server_streaming(); }

Result<HttpRuleRouter> HttpRuleRouter::FromServices(const std::vector<const ServiceDescriptor*>& services) {
  HttpRuleRouter router;
  for (const ServiceDescriptor* service : services) {
    for (int i = 0; i < service->method_count(); ++i) {
      DHPMAP_RETURN_IF_ERROR(AddRoutes(*service->method(i), &router.routes_));
    }
  }
  std::stable_sort(router.routes_.begin(), router.routes_.end(), MoreSpecific);
  std::set<std::string> shapes;
  for (const Route& route : router.routes_) {
    if (!shapes.insert(route.http_method + " " + route.path.Shape()).second) {
      return Wrong(*route.method, route.http_method + " " + route.path.text() + " is taken by another RPC");
    }
  }
  return router;
}

Result<HttpRuleRouter> HttpRuleRouter::FromLinkedServices() {
  LinkProtos();
  std::vector<std::string> files;
  google::protobuf::DescriptorPool::internal_generated_database()->FindAllFileNames(&files);
  std::sort(files.begin(), files.end());
  std::vector<const ServiceDescriptor*> services;
  for (const std::string& name : files) {
    const auto* file = google::protobuf::DescriptorPool::generated_pool()->FindFileByName(name);
    for (int i = 0; file != nullptr && i < file->service_count(); ++i) services.push_back(file->service(i));
  }
  return FromServices(services);
}

RouteMatch HttpRuleRouter::Find(std::string_view http_method, std::string_view encoded_path) const {
  if (http_method == "HEAD") http_method = "GET";
  for (const Route& route : routes_) {
    if (route.http_method != http_method) continue;
    if (auto values = route.path.Match(encoded_path)) return {&route, std::move(*values)};
  }
  return {};
}

std::string HttpRuleRouter::AllowedMethods(std::string_view encoded_path) const {
  std::set<std::string_view> methods;
  for (const Route& route : routes_) {
    if (!route.path.Match(encoded_path)) continue;
    methods.insert(route.http_method);
    if (route.http_method == "GET") methods.insert("HEAD");
  }
  std::string allowed;
  for (const std::string_view method : methods) {
    if (!allowed.empty()) allowed += ", ";
    allowed += method;
  }
  return allowed;
}

}  // namespace dhpmap::gateway
