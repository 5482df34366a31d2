// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "clients/cli/connection.h"
#include "clients/cli/output_file.h"
#include "clients/cli/progress_bar.h"
#include "clients/cli/text_table.h"

namespace dhpmap {

inline std::string MegabytesASecond(std::int64_t num_bytes, double elapsed_s) {
  return Fixed(static_cast<double>(num_bytes) / 1e6 / std::max(elapsed_s, 1e-3), 1) + " MB/s";
}

/// Writes a file that the server sends in parts (`data`, and `total_bytes` in the first), and publishes it once it is
/// complete. Calls `on_part(part)` for each. Reports progress and errors on standard error; `what`: "mesh".
template <typename Part, typename OnPart>
ExitCode Download(const Session& session, client::Parts<Part>& parts, const std::string& what, OutputFile& file,
                  OnPart on_part) {
  Part part;
  std::int64_t total_bytes = 0;
  std::optional<ProgressBar> progress;
  while (parts.Next(part)) {
    total_bytes = std::max(total_bytes, part.total_bytes());
    file.Write(part.data());
    on_part(part);
    if (!progress) progress.emplace(static_cast<std::size_t>(total_bytes), "bytes");
    progress->Show(static_cast<std::size_t>(file.num_bytes()),
                   MegabytesASecond(file.num_bytes(), progress->elapsed_s()));
  }
  progress.reset();
  if (const client::Status status = parts.Finish(); !status.ok()) return ReportError(session, status);
  if (file.num_bytes() != total_bytes) {
    return ReportLocalError("the " + what + " came in short: " + std::to_string(file.num_bytes()) + " of " +
                                std::to_string(total_bytes) + " bytes",
                            ExitCode::kServerFailed);
  }
  const Status closed = file.Close();
  return closed.ok() ? ExitCode::kOk : ReportLocalError(closed.message());
}

}  // namespace dhpmap
