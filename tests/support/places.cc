// SPDX-License-Identifier: BSD-3-Clause
// The one file that knows absolute paths: a compiler cache can share all others between checkouts.
#include "tests/support/places.h"

namespace dhpmap::testing {

std::filesystem::path SourceDir() { return DHPMAP_SOURCE_DIR; }
std::filesystem::path ProgramDir() { return DHPMAP_BIN_DIR; }

}  // namespace dhpmap::testing
