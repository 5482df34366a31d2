// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "mapping/base/reason.h"

namespace dhpmap {

/// The one table from status codes to what each door shows: gRPC the number, REST the HTTP status.
struct StatusRow {
  StatusCode code;
  int grpc_code;
  int http_status;
};
std::span<const StatusRow> StatusTable();

/// Reasons that HTTP shows by a status of their own, whatever their code.
struct ReasonStatusRow {
  Reason reason;
  int http_status;
};
std::span<const ReasonStatusRow> ReasonStatusTable();

/// What HTTP shows of a failure: the status of its reason where that has one of its own, else that of its code; 500 for
/// a number that is no code.
int HttpStatusOf(int grpc_code, Reason reason = {});

}  // namespace dhpmap
