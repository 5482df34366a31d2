// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

namespace dhpmap {

/// What every command that edits takes, as every request that edits does: whose it is, under which id it may be sent
/// again, whether it is only tried, and what the state must be that it meets.
struct EditFlags {
  std::string author, request_id, etag;
  std::int64_t expected_revision = 0;
  bool only_try = false;

  /// All that is set but the etag, which some requests have in what they name; a request that came as JSON may have
  /// the others already.
  template <typename Request>
  void Sign(Request& request) const {
    if (!author.empty()) request.set_author(author);
    if (!request_id.empty()) request.set_request_id(request_id);
    if (only_try) request.set_validate_only(true);
    if (expected_revision > 0) request.set_expected_revision(expected_revision);
  }
};

/// Writes to `flags`, which must outlive the command. `of_what` the etag is; `who` the author is, for the help.
void AddEditFlags(CLI::App& command, EditFlags& flags, const std::string& of_what,
                  const std::string& who = "Author, for the log");

}  // namespace dhpmap
