// SPDX-License-Identifier: BSD-3-Clause
#include "proto/types/status_conversion.h"

#include <charconv>

#include "google/rpc/error_details.pb.h"
#include "mapping/base/utf8.h"

namespace dhpmap {
namespace {

/// The message, and the first violation beside it if it does not say that anyway: few look into the details.
std::string MessageOf(const Status& status) {
  std::string message = status.message();
  if (status.violations().empty()) return message;
  const FieldViolation& first = status.violations().front();
  if (message.find(first.description) == std::string::npos || message.find(first.field) == std::string::npos) {
    message += (message.empty() ? "" : ": ") + first.field + ": " + first.description;
  }
  const std::size_t more = status.violations().size() - 1;
  if (more > 0) message += ", and " + std::to_string(more) + " more";
  return message;
}

/// Whole seconds, as both gRPC's clients and Retry-After have it; 0: none said.
int RetryAfter_s(const Status& status) {
  int seconds = 0;
  for (const auto& [key, value] : status.metadata()) {
    if (key == "retry_after_s") (void)std::from_chars(value.data(), value.data() + value.size(), seconds);
  }
  return seconds;
}

}  // namespace

google::rpc::Status ToProto(const Status& status) {
  google::rpc::Status proto;
  proto.set_code(static_cast<int>(status.code()));
  proto.set_message(ToValidUtf8(MessageOf(status)));
  if (!status.reason().empty()) {
    google::rpc::ErrorInfo info;
    info.set_reason(std::string(status.reason().name()));
    info.set_domain("dhpmap");
    for (const auto& [key, value] : status.metadata()) (*info.mutable_metadata())[key] = ToValidUtf8(value);
    proto.add_details()->PackFrom(info);
  }
  if (!status.violations().empty()) {
    google::rpc::BadRequest bad;
    for (const FieldViolation& violation : status.violations()) {
      auto* field = bad.add_field_violations();
      field->set_field(ToValidUtf8(violation.field));
      field->set_description(ToValidUtf8(violation.description));
    }
    proto.add_details()->PackFrom(bad);
  }
  if (const int seconds = RetryAfter_s(status); seconds > 0) {
    google::rpc::RetryInfo retry;
    retry.mutable_retry_delay()->set_seconds(seconds);
    proto.add_details()->PackFrom(retry);
  }
  return proto;
}

ErrorDetails ReadErrorDetails(const std::string& bytes) {
  ErrorDetails result;
  google::rpc::Status proto;
  if (bytes.empty() || !proto.ParseFromString(bytes)) return result;
  for (const auto& detail : proto.details()) {
    google::rpc::BadRequest bad;
    google::rpc::ErrorInfo info;
    if (detail.UnpackTo(&bad)) {
      for (const auto& field : bad.field_violations())
        result.violations.push_back({field.field(), field.description()});
    } else if (detail.UnpackTo(&info)) {
      result.reason = info.reason();
    }
  }
  return result;
}

}  // namespace dhpmap
