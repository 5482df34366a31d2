// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "mapping/query/relations.h"
#include "mapping/query/submap_search.h"
#include "server/wire/paging.h"

namespace dhpmap {

// Page keys of matches and relations, and the position after which a page starts: nothing for the first.
// INVALID_ARGUMENT for a page token without such a key.

std::string KeyOf(const SubmapMatch& match);
Result<std::optional<MatchPlace>> MatchFromPage(const Pager& pager);

std::string KeyOf(const Relation& relation);
Result<std::optional<RelationPlace>> RelationFromPage(const Pager& pager);

}  // namespace dhpmap
