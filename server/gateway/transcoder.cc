// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/transcoder.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <limits>

#include "proto/types/message_outline.h"
#include "server/json/reader.h"
#include "server/json/writer.h"

namespace dhpmap::gateway {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

bool IsBlank(std::string_view text) { return text.find_first_not_of(" \t\r\n") == std::string_view::npos; }

bool Parse(std::string_view bytes, Message* message) {
  return message->ParseFromArray(bytes.data(), static_cast<int>(bytes.size()));
}

/// Whether "1,2,3" means three values: only if a value cannot contain a comma.
bool IsListOfPlainValues(const FieldDescriptor& field) {
  return field.is_repeated() && field.message_type() == nullptr && field.cpp_type() != FieldDescriptor::CPPTYPE_STRING;
}

Status SetFromList(const json::FieldPath& field, std::string_view text, Message* request) {
  while (true) {
    const std::size_t comma = text.find(',');
    DHPMAP_RETURN_IF_ERROR(json::SetFieldFromText(field, text.substr(0, comma), request));
    if (comma == std::string_view::npos) return Status::Ok();
    text.remove_prefix(comma + 1);
  }
}

const FieldDescriptor* EtagOf(const Descriptor& type) {
  const FieldDescriptor* field = type.FindFieldByName("etag");
  return field != nullptr && !field->is_repeated() && field->type() == FieldDescriptor::TYPE_STRING ? field : nullptr;
}

/// The field of the RPC's request that takes an etag; empty if there is none.
json::FieldPath EtagFieldOf(const Route& route) {
  if (const FieldDescriptor* own = EtagOf(*route.method->input_type())) return {own};
  if (route.body_field == nullptr || route.body_field->message_type() == nullptr) return {};
  const FieldDescriptor* field = EtagOf(*route.body_field->message_type());
  return field == nullptr ? json::FieldPath{} : json::FieldPath{route.body_field, field};
}

bool StartsWith(const json::FieldPath& path, const json::FieldPath& prefix) {
  return path.size() >= prefix.size() && std::equal(prefix.begin(), prefix.end(), path.begin());
}

}  // namespace

std::unique_ptr<Message> NewMessage(const Descriptor& type) {
  const Message* prototype = google::protobuf::MessageFactory::generated_factory()->GetPrototype(&type);
  return std::unique_ptr<Message>(prototype->New());
}

Result<RequestTranscoder> RequestTranscoder::Make(RouteMatch match, std::string_view query) {
  auto pairs = http::ParseQuery(query);
  if (!pairs) return InvalidArgument("the query has a broken percent escape").WithReason("BAD_QUERY");
  return RequestTranscoder(std::move(match), std::move(*pairs));
}

Status RequestTranscoder::SetIfMatch(std::string_view header) {
  const bool is_there = header.data() != nullptr;
  if (!is_there || header == "*") return Status::Ok();
  constexpr std::size_t kLeast = 3;  // an empty tag would mean no precondition
  if (header.size() < kLeast || header.front() != '"' || header.find('"', 1) != header.size() - 1) {
    return InvalidArgument("header If-Match must be one entity tag in double quotes, or *").WithReason("BAD_HEADER");
  }
  etag_field_ = EtagFieldOf(*match_.route);
  if (etag_field_.empty()) {
    return InvalidArgument("this request takes no etag, so no If-Match either").WithReason("BAD_HEADER");
  }
  if_match_ = header.substr(1, header.size() - 2);
  return Status::Ok();
}

void RequestTranscoder::SetLastEventId(std::string_view header) {
  if (match_.route->events) last_event_id_ = header;
}

Result<std::string> RequestTranscoder::ToRequest(BodyFormat format, std::string_view body,
                                                 const json::AskRoom& ask) const {
  const auto request = NewMessage(*match_.route->method->input_type());
  std::vector<std::string> paths;
  std::size_t message_bytes = 0;
  const auto note = [&ask, &message_bytes](std::size_t num_bytes) {
    message_bytes = num_bytes;
    return ask == nullptr ? Status::Ok() : ask(num_bytes);
  };
  DHPMAP_RETURN_IF_ERROR(ReadBody(format, body, request.get(), &paths, note));
  DHPMAP_RETURN_IF_ERROR(ApplyQuery(request.get()));
  DHPMAP_RETURN_IF_ERROR(ApplyPath(request.get()));
  DHPMAP_RETURN_IF_ERROR(ApplyIfMatch(request.get()));
  ApplyFileSize(request.get());
  if (!last_event_id_.empty()) {
    request->GetReflection()->SetString(request.get(), match_.route->events->resume_after, last_event_id_);
  }
  DeriveMask(paths, request.get());
  if (message_bytes > 0) DHPMAP_RETURN_IF_ERROR(note(message_bytes + request->ByteSizeLong()));
  return request->SerializeAsString();
}

Status RequestTranscoder::ReadBody(BodyFormat format, std::string_view body, Message* request, json::Paths* paths,
                                   const json::AskRoom& ask) const {
  const Route& route = *match_.route;
  if (route.body == Route::Body::kNone) {
    if (IsBlank(body)) return Status::Ok();
    return InvalidArgument(route.http_method + " " + route.path.text() + " takes no body")
        .WithReason("UNEXPECTED_BODY");
  }
  if (format == BodyFormat::kJson) {
    if (IsBlank(body)) return Status::Ok();
    if (route.body == Route::Body::kWhole) return json::Read(body, request, paths, ask);
    return json::ReadField(body, *route.body_field, request, paths, ask);
  }
  if (format == BodyFormat::kFile) {
    request->GetReflection()->SetString(request, route.body_field, std::string(body));
    return Status::Ok();
  }
  return ReadProtobuf(body, request, ask);
}

Status RequestTranscoder::ReadProtobuf(std::string_view body, Message* request, const json::AskRoom& ask) const {
  const Route& route = *match_.route;
  Message* into = request;
  if (route.body == Route::Body::kField) {
    if (route.body_field->message_type() == nullptr || route.body_field->is_repeated()) {
      return InvalidArgument("this body is no message: send it as JSON").WithReason("MALFORMED_PROTOBUF");
    }
    into = request->GetReflection()->MutableMessage(request, route.body_field);
  }
  const auto outline = LayoutOf(*into->GetDescriptor()).OutlineOf(body);
  if (outline.ok()) DHPMAP_RETURN_IF_ERROR(ask(outline->message_bytes));
  if (outline.ok() && Parse(body, into)) return Status::Ok();
  return InvalidArgument("the body is not a protobuf message of type " + into->GetDescriptor()->full_name())
      .WithReason("MALFORMED_PROTOBUF");
}

Status RequestTranscoder::CheckParameter(const std::string& name, const json::FieldPath& field) const {
  const Route& route = *match_.route;
  const auto refuse = [&](const std::string& why) -> Status {
    return std::move(InvalidArgument("query parameter '" + name + "': " + why).WithReason("BAD_QUERY"))
        .WithViolation(name, why);
  };
  for (const json::FieldPath& variable : route.variables) {
    if (field == variable) return refuse("the path gives this field");
  }
  if (route.body == Route::Body::kWhole) return refuse("fields of this request belong into the body");
  if (route.body == Route::Body::kField && StartsWith(field, {route.body_field})) {
    return refuse("this field belongs into the body");
  }
  return Status::Ok();
}

Status RequestTranscoder::ApplyQuery(Message* request) const {
  json::FieldPath field;
  std::vector<json::FieldPath> set;
  for (const auto& [name, value] : query_) {
    if (Status found = json::ResolveFieldPath(*request->GetDescriptor(), name, &field); !found.ok()) {
      return std::move(InvalidArgument("query parameter '" + name + "': " + found.message()).WithReason("BAD_QUERY"))
          .WithViolation(name, "no such field");
    }
    DHPMAP_RETURN_IF_ERROR(CheckParameter(name, field));
    if (IsListOfPlainValues(*field.back())) {
      DHPMAP_RETURN_IF_ERROR(SetFromList(field, value, request));
      continue;
    }
    if (!field.back()->is_repeated() && std::find(set.begin(), set.end(), field) != set.end()) {
      return std::move(InvalidArgument("query parameter '" + name + "' is given twice").WithReason("BAD_QUERY"))
          .WithViolation(name, "given twice");
    }
    DHPMAP_RETURN_IF_ERROR(json::SetFieldFromText(field, value, request));
    set.push_back(field);
  }
  return Status::Ok();
}

Status RequestTranscoder::ApplyPath(Message* request) const {
  for (std::size_t i = 0; i < match_.values.size(); ++i) {
    DHPMAP_RETURN_IF_ERROR(json::SetFieldFromText(match_.route->variables[i], match_.values[i], request));
  }
  return Status::Ok();
}

Status RequestTranscoder::ApplyIfMatch(Message* request) const {
  if (if_match_.empty()) return Status::Ok();
  Message* holder = request;
  for (std::size_t i = 0; i + 1 < etag_field_.size(); ++i) {
    holder = holder->GetReflection()->MutableMessage(holder, etag_field_[i]);
  }
  const FieldDescriptor* etag = etag_field_.back();
  const std::string given = holder->GetReflection()->GetString(*holder, etag);
  if (!given.empty() && given != if_match_) {
    return InvalidArgument("If-Match and etag name different states").WithReason("BAD_HEADER");
  }
  holder->GetReflection()->SetString(holder, etag, if_match_);
  return Status::Ok();
}

void RequestTranscoder::ApplyFileSize(Message* request) const {
  const FieldDescriptor* field = request->GetDescriptor()->FindFieldByName("total_bytes");
  if (file_bytes_ == 0 || field == nullptr || field->cpp_type() != FieldDescriptor::CPPTYPE_INT64) return;
  const auto* reflection = request->GetReflection();
  if (field->is_repeated() || reflection->GetInt64(*request, field) != 0) return;
  const auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  reflection->SetInt64(request, field, static_cast<std::int64_t>(std::min(file_bytes_, most)));
}

void RequestTranscoder::DeriveMask(const json::Paths& paths, Message* request) const {
  const Route& route = *match_.route;
  if (route.update_mask == nullptr || route.body != Route::Body::kField || paths.empty()) return;
  const auto* reflection = request->GetReflection();
  if (reflection->HasField(*request, route.update_mask)) return;
  Message* mask = reflection->MutableMessage(request, route.update_mask);
  const FieldDescriptor* mask_paths = mask->GetDescriptor()->FindFieldByName("paths");
  const std::string prefix = route.body_field->name() + ".";
  for (const std::string& path : paths) {
    const bool in_url =
        std::any_of(route.variables.begin(), route.variables.end(),
                    [&](const json::FieldPath& variable) { return json::ToString(variable) == prefix + path; });
    if (!in_url && path != "etag") mask->GetReflection()->AddString(mask, mask_paths, path);
  }
}

Result<std::string> ToAnswer(const Route& route, std::string response, AnswerFormat format) {
  if (format == AnswerFormat::kProtobuf && route.response_field == nullptr) return response;
  const auto message = NewMessage(*route.method->output_type());
  if (!Parse(response, message.get()))
    return Internal("the answer is not a " + route.method->output_type()->full_name());
  std::string out;
  if (route.response_field == nullptr) {
    json::Append(*message, &out);
  } else if (format == AnswerFormat::kProtobuf && route.response_field->message_type() != nullptr &&
             !route.response_field->is_repeated()) {
    return message->GetReflection()->GetMessage(*message, route.response_field).SerializeAsString();
  } else {
    json::AppendField(*message, *route.response_field, &out);
  }
  return out;
}

namespace {

std::string ToEvent(const Route& route, const Message& message) {
  std::string out;
  const auto& reflection = *message.GetReflection();
  if (route.events) {
    const FieldDescriptor* kind = reflection.GetOneofFieldDescriptor(message, route.events->event);
    if (kind != nullptr && kind->message_type() != nullptr && kind->message_type()->field_count() == 0) {
      return ": " + kind->name() + "\n\n";
    }
    if (kind != nullptr) out += "event: " + kind->name() + "\n";
    out += "id: " + reflection.GetString(message, route.events->position) + "\n";
  }
  out += "data: ";
  json::Append(message, &out);
  return out + "\n\n";
}

}  // namespace

Result<std::string> ToStreamAnswer(const Route& route, std::string_view response, AnswerFormat format) {
  std::string out;
  if (format == AnswerFormat::kProtobuf) {
    AppendVarint(response.size(), &out);
    out += response;
    return out;
  }
  const auto message = NewMessage(*route.method->output_type());
  if (!Parse(response, message.get()))
    return Internal("the answer is not a " + route.method->output_type()->full_name());
  if (format == AnswerFormat::kEvents) return ToEvent(route, *message);
  out = R"({"result":)";
  if (route.response_field != nullptr) {
    json::AppendField(*message, *route.response_field, &out);
  } else {
    json::Append(*message, &out);
  }
  out += "}\n";
  return out;
}

void AppendVarint(std::uint64_t size, std::string* out) {
  while (size >= 0x80) {
    *out += static_cast<char>(size | 0x80);
    size >>= 7;
  }
  *out += static_cast<char>(size);
}

}  // namespace dhpmap::gateway
