// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

#include "mapping/base/status.h"

namespace dhpmap {

/// The one table from status codes to what each door shows: gRPC the number, REST the HTTP status.
struct StatusRow {
  StatusCode code;
  int grpc_code;
  int http_status;
};
std::span<const StatusRow> StatusTable();

/// 500 for a number that is not in the table.
int HttpStatusOf(int grpc_code);

}  // namespace dhpmap
