// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/types/http_status.h"

#include <array>

namespace dhpmap {
namespace {

constexpr std::array<StatusRow, 17> kTable = {{
    {StatusCode::kOk, 0, 200},
    {StatusCode::kCancelled, 1, 499},
    {StatusCode::kUnknown, 2, 500},
    {StatusCode::kInvalidArgument, 3, 400},
    {StatusCode::kDeadlineExceeded, 4, 504},
    {StatusCode::kNotFound, 5, 404},
    {StatusCode::kAlreadyExists, 6, 409},
    {StatusCode::kPermissionDenied, 7, 403},
    {StatusCode::kResourceExhausted, 8, 429},
    {StatusCode::kFailedPrecondition, 9, 400},
    {StatusCode::kAborted, 10, 409},
    {StatusCode::kOutOfRange, 11, 400},
    {StatusCode::kUnimplemented, 12, 501},
    {StatusCode::kInternal, 13, 500},
    {StatusCode::kUnavailable, 14, 503},
    {StatusCode::kDataLoss, 15, 500},
    {StatusCode::kUnauthenticated, 16, 401},
}};

}  // namespace

std::span<const StatusRow> StatusTable() { return kTable; }

int HttpStatusOf(int grpc_code, Reason reason) {
  if (reason.http_status() != 0) return reason.http_status();
  if (grpc_code < 0 || grpc_code >= static_cast<int>(kTable.size())) return 500;
  return kTable[static_cast<std::size_t>(grpc_code)].http_status;
}

}  // namespace dhpmap
