// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/sync_stream.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "clients/cli/connection.h"
#include "clients/cli/output_file.h"

namespace dhpmap {

/// Writes a file that the server sends in parts (`data`, and `total_bytes` in the first) and puts it into its place
/// once all of it has come. `on_part(part)` sees each. Says why not on standard error; `what`: "mesh".
template <typename Part, typename OnPart>
ExitCode Download(const Session& session, grpc::ClientReaderInterface<Part>& stream, const std::string& what,
                  OutputFile& file, OnPart on_part) {
  Part part;
  std::int64_t total_bytes = 0;
  while (stream.Read(&part)) {
    total_bytes = std::max(total_bytes, part.total_bytes());
    file.Write(part.data());
    on_part(part);
  }
  const grpc::Status status = stream.Finish();
  if (!status.ok()) return ReportError(session, status);
  if (file.num_bytes() != total_bytes) {
    return ReportLocalError("the " + what + " came in short: " + std::to_string(file.num_bytes()) + " of " +
                                std::to_string(total_bytes) + " bytes",
                            ExitCode::kServerFailed);
  }
  const Status closed = file.Close();
  return closed.ok() ? ExitCode::kOk : ReportLocalError(closed.message());
}

}  // namespace dhpmap
