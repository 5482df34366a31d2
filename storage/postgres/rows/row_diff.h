// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "storage/postgres/rows/table_text.h"
#include "storage/postgres/values.h"

namespace dhpmap::postgres {

/// Adds the statements that change a table's rows from `before` to `after`. Each type of row has one table.
template <typename Row>
void WriteDiff(const Table<Row>& table, const std::vector<Row>& before, const std::vector<Row>& after,
               std::vector<Call>& calls) {
  static const std::string upsert = UpsertText(table), erase = DeleteText(table);
  constexpr bool kOfKey = true, kOfAll = false;
  std::map<std::string, const Row*> old;
  for (const Row& row : before) old[BytesOf(table, row, kOfKey)] = &row;
  for (const Row& row : after) {
    const auto known = old.find(BytesOf(table, row, kOfKey));
    const bool is_same = known != old.end() && BytesOf(table, *known->second, kOfAll) == BytesOf(table, row, kOfAll);
    if (!is_same) table.BindAll(row, calls.emplace_back(Call{&upsert}).values);
    if (known != old.end()) old.erase(known);
  }
  for (const auto& entry : old) BindKey(table, *entry.second, calls.emplace_back(Call{&erase}).values);
}

}  // namespace dhpmap::postgres
