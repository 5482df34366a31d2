// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/confirmation.h"

#include <istream>
#include <ostream>

namespace dhpmap {

Status Confirm(const std::string& question, bool is_terminal, std::istream& in, std::ostream& out) {
  if (!is_terminal) return FailedPrecondition("there is no terminal to ask at: say --yes");
  out << question << " [y/N] " << std::flush;
  std::string answer;
  std::getline(in, answer);
  const std::size_t end = answer.find_last_not_of(" \t\r");
  answer.resize(end == std::string::npos ? 0 : end + 1);
  for (const char* yes : {"y", "Y", "yes", "Yes", "YES"}) {
    if (answer == yes) return Status::Ok();
  }
  return Aborted("nothing was done");
}

}  // namespace dhpmap
