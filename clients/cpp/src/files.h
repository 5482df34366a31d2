// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "clients/cpp/calls/error.h"
#include "clients/cpp/calls/parts.h"
#include "dhpmap/files.h"
#include "dhpmap/result.h"

namespace dhpmap::client {

/// Passes on a file that the server sends in parts: `data`, and `total_bytes` in the first.
template <typename Part>
Result<FileInfo> TakeFile(Parts<Part>& parts, const TakePart& take) {
  FileInfo info;
  std::int64_t total_bytes = 0;
  for (Part part; parts.Next(part);) {
    if (part.total_bytes() > 0) total_bytes = part.total_bytes();
    if constexpr (requires { part.revision(); }) info.revision = part.revision();
    if constexpr (requires { part.etag(); }) info.etag = info.etag.empty() ? part.etag() : info.etag;
    info.num_bytes += static_cast<std::int64_t>(part.data().size());
    if (!take({part.data(), total_bytes})) return Error(StatusCode::kCancelled, "no more of the file is wanted");
  }
  if (Status status = parts.Finish(); !status.ok()) return status;
  if (info.num_bytes != total_bytes) {
    return Error(StatusCode::kDataLoss, "the file came in short: " + std::to_string(info.num_bytes) + " of " +
                                            std::to_string(total_bytes) + " bytes");
  }
  return info;
}

}  // namespace dhpmap::client
