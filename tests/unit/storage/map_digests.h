// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace dhpmap::testing {

/// 128 bits, FNV-1a, as hexadecimal digits. Each byte goes through steps that lose nothing, so texts that differ in one
/// byte differ here; other texts that differ agree once in 2^128. Nobody has a reason to make two that agree.
std::string DigestOf(std::string_view text);

/// What a map's text says (map_text.h, and lines "config KEY = VALUE"), as a line a section: a digest of all that is in
/// it, and what a reader looks for. Sections are the map's row, its classes, what was merged, pairs, regions that are
/// kept clear, each submap with its blocks, and the config.
std::string DigestsOf(std::string_view map_text);

}  // namespace dhpmap::testing
