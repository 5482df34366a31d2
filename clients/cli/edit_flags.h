// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

namespace dhpmap {

/// Flags of all editing commands: the author, a request id for safe retries, a dry run, and preconditions on the state.
struct EditFlags {
  std::string author, request_id, etag;
  std::int64_t expected_revision = 0;
  bool only_try = false;

  /// Sets the given fields of a request, except the etag, which some requests have in another message. Fields of a
  /// request that was read from JSON are kept unless a flag is given.
  template <typename Request>
  void Sign(Request& request) const {
    if (!author.empty()) request.set_author(author);
    if (!request_id.empty()) request.set_request_id(request_id);
    if (only_try) request.set_validate_only(true);
    if (expected_revision > 0) request.set_expected_revision(expected_revision);
  }
};

/// Writes to `flags`, which must outlive the command. `of_what` has the etag, `who` is the author: for the help.
void AddEditFlags(CLI::App& command, EditFlags& flags, const std::string& of_what,
                  const std::string& who = "Author, for the log");

}  // namespace dhpmap
