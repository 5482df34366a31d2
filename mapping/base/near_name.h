// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace dhpmap {

/// How many letters are missing, too many, others, or exchanged with their neighbour, where ASCII case does not count:
/// 1 for "sofaa" and "sofa", "sfoa" and "sofa".
int SpellingDistance(std::string_view a, std::string_view b);

/// Of `names` the one that somebody who wrote `wrong` is likeliest to have meant: it begins so, or no more than a third
/// of its letters differ. Of equals the first; empty if none is near. Looks at the first 1,000 names, and at no more
/// than 40 letters, so that it may be asked for what strangers send.
std::string NearestName(std::string_view wrong, std::span<const std::string> names);

/// "; did you mean 'sofa'?" for the end of an error message, or nothing.
std::string DidYouMean(std::string_view wrong, std::span<const std::string> names);

}  // namespace dhpmap
