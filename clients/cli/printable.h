// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace dhpmap {

/// Makes untrusted text safe for a terminal: control characters, line ends and direction marks are escaped as "\x1b" or
/// "\u202e", and so are bytes that are not UTF-8. Use it for all text from a map that is printed; TextTable does it
/// itself, and JSON has its own escapes.
std::string Printable(std::string_view text);

}  // namespace dhpmap
