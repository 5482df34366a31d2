// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/edit_flags.h"

namespace dhpmap {

void AddEditFlags(CLI::App& command, EditFlags& flags, const std::string& of_what, const std::string& who) {
  command.add_option("--author", flags.author, who)->envname("DHPMAP_AUTHOR");
  command.add_option("--request-id", flags.request_id, "UUID of the request: a repeated one is not executed again");
  command.add_flag("--validate-only", flags.only_try, "Report the effect without changing anything");
  command.add_option("--etag", flags.etag, "Only if this etag still holds: of " + of_what);
  command.add_option("--expected-revision", flags.expected_revision, "Only if it was not edited after this revision")
      ->check(CLI::PositiveNumber);
}

}  // namespace dhpmap
