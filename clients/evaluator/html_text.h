// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "clients/evaluator/picture.h"

namespace dhpmap::evaluator {

/// What HTML takes for markup, as text: also within attributes in double quotes.
std::string Escaped(std::string_view text);
/// <table> of a table in Markdown whose columns are aligned as MarkdownTable does.
std::string HtmlOfTable(std::string_view markdown);
/// An <img> that has its pixels in itself.
std::string InlineImage(const Picture& picture, std::string_view what);
std::string Base64(std::string_view bytes);

}  // namespace dhpmap::evaluator
