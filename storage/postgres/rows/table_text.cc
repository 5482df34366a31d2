// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/rows/table_text.h"

#include <functional>

namespace dhpmap::postgres {
namespace {

using Wanted = bool (*)(Written);
bool IsThere(Written written) { return written != Written::kElsewhere; }
bool IsKey(Written written) { return written == Written::kOnce; }
bool IsAlways(Written written) { return written == Written::kAlways; }

/// Joins text(column, number) over the wanted columns.
std::string Join(const TableSql& table, Wanted wanted, const char* between,
                 const std::function<std::string(const std::string& name, int number)>& text,
                 const MoreColumns& more = {}) {
  std::string joined;
  int number = 0;
  const auto add = [&](const std::string& name) { joined += (joined.empty() ? "" : between) + text(name, ++number); };
  for (const ColumnName& column : table.columns()) {
    if (wanted(column.written)) add(column.name);
  }
  for (const std::string& name : more) add(name);
  return joined;
}

std::string Name(const std::string& name, int) { return name; }
std::string Parameter(const std::string&, int number) { return std::string(1, '$') += std::to_string(number); }
std::string Assignment(const std::string& name, int number) { return name + " = $" + std::to_string(number); }
std::string Excluded(const std::string& name, int) { return name + " = excluded." + name; }

}  // namespace

std::string SelectText(const TableSql& table, std::string_view tail, const MoreColumns& more) {
  return "SELECT " + Join(table, IsThere, ", ", Name, more) + " FROM " + table.table() + " " + std::string(tail);
}

std::string InsertText(const TableSql& table, const MoreColumns& more) {
  return std::string("INSERT INTO ") + table.table() + " (" + Join(table, IsThere, ", ", Name, more) + ") VALUES (" +
         Join(table, IsThere, ", ", Parameter, more) + ")";
}

std::string UpsertText(const TableSql& table) {
  return InsertText(table) + " ON CONFLICT (" + Join(table, IsKey, ", ", Name) + ") DO UPDATE SET " +
         Join(table, IsAlways, ", ", Excluded);
}

std::string DeleteText(const TableSql& table) {
  return std::string("DELETE FROM ") + table.table() + " WHERE " + Join(table, IsKey, " AND ", Assignment);
}

std::string AssignmentsText(const TableSql& table, const MoreColumns& more) {
  return Join(table, IsAlways, ", ", Assignment, more);
}

}  // namespace dhpmap::postgres
