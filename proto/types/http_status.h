// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "mapping/base/reason.h"

namespace dhpmap {

/// The one table of status codes at both doors: the number for gRPC, the HTTP status for REST.
struct StatusRow {
  StatusCode code;
  int grpc_code;
  int http_status;
};
std::span<const StatusRow> StatusTable();

/// Reasons with an HTTP status of their own, whatever their code.
struct ReasonStatusRow {
  Reason reason;
  int http_status;
};
std::span<const ReasonStatusRow> ReasonStatusTable();

/// HTTP status of a failure: that of its reason if it has its own, else that of its code; 500 for an unknown code.
int HttpStatusOf(int grpc_code, Reason reason = {});

}  // namespace dhpmap
