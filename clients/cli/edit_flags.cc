// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/edit_flags.h"

namespace dhpmap {

void AddEditFlags(CLI::App& command, EditFlags& flags, const std::string& of_what, const std::string& who) {
  command.add_option("--author", flags.author, who)->envname("DHPMAP_AUTHOR");
  command.add_option("--request-id", flags.request_id, "UUID: sent again with the same one, it is not done again");
  command.add_flag("--validate-only", flags.only_try, "Say what would become of it, and change nothing");
  command.add_option("--etag", flags.etag, "Only if this etag still holds: of " + of_what);
  command
      .add_option("--expected-revision", flags.expected_revision, "Only if nobody has edited it after this revision")
      ->check(CLI::PositiveNumber);
}

}  // namespace dhpmap
