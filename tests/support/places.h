// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace dhpmap::testing {

/// The checkout these tests were built from.
std::filesystem::path SourceDir();
/// Where the programs of this build are.
std::filesystem::path ProgramDir();

}  // namespace dhpmap::testing
