// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace dhpmap {

/// Text that somebody else has written, for a terminal: what would move the cursor, change colours, begin a line or
/// turn the direction of writing is shown as what it is, "\x1b" or "\u202e", and so are bytes that are no UTF-8.
/// Whatever comes from a map goes through it on its way to people; TextTable does so by itself, and JSON has escapes of
/// its own.
std::string Printable(std::string_view text);

}  // namespace dhpmap
