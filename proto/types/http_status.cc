// SPDX-License-Identifier: BSD-3-Clause
#include "proto/types/http_status.h"

#include <algorithm>
#include <array>
#include <iterator>

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

constexpr ReasonStatusRow kReasons[] = {
    {"HISTORY_LOST", 410},       {"REVISION_NOT_KEPT", 410}, {"COMPACTED", 410},
    {"METHOD_NOT_ALLOWED", 405}, {"BODY_TOO_LARGE", 413},    {"UNSUPPORTED_MEDIA_TYPE", 415},
    {"NOT_ACCEPTABLE", 406},     {"HEADER_TOO_LARGE", 431},  {"HOST_NOT_ALLOWED", 421},
};

}  // namespace

std::span<const StatusRow> StatusTable() { return kTable; }

std::span<const ReasonStatusRow> ReasonStatusTable() { return kReasons; }

int HttpStatusOf(int grpc_code, Reason reason) {
  const auto* own = std::find_if(std::begin(kReasons), std::end(kReasons),
                                 [reason](const ReasonStatusRow& row) { return row.reason == reason; });
  if (own != std::end(kReasons)) return own->http_status;
  if (grpc_code < 0 || grpc_code >= static_cast<int>(kTable.size())) return 500;
  return kTable[static_cast<std::size_t>(grpc_code)].http_status;
}

}  // namespace dhpmap
