// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/table.h"

#include <functional>

namespace dhpmap {
namespace {

/// Joins text(column) of the columns for which `wanted` returns true, separated by commas.
std::string Join(const std::vector<ColumnName>& columns, const std::function<bool(Written)>& wanted,
                 const std::function<std::string(const std::string&)>& text) {
  std::string joined;
  for (const ColumnName& column : columns) {
    if (wanted(column.written)) joined += (joined.empty() ? "" : ", ") + text(column.name);
  }
  return joined;
}

bool Any(Written) { return true; }
bool Inserted(Written written) { return written != Written::kElsewhere; }
bool Updated(Written written) { return written == Written::kAlways; }
bool Identifies(Written written) { return written == Written::kOnce; }

std::string Name(const std::string& name) { return name; }
std::string Parameter(const std::string&) { return "?"; }
std::string Assignment(const std::string& name) { return name + " = ?"; }
std::string Excluded(const std::string& name) { return name + " = excluded." + name; }

}  // namespace

std::string TableSql::Select(std::string_view tail) const {
  return "SELECT " + Join(columns_, Any, Name) + " FROM " + table_ + " " + std::string(tail);
}

std::string TableSql::Insert() const {
  return std::string("INSERT INTO ") + table_ + " (" + Join(columns_, Inserted, Name) + ") VALUES (" +
         Join(columns_, Inserted, Parameter) + ")";
}

std::string TableSql::Upsert() const {
  return Insert() + " ON CONFLICT (" + Join(columns_, Identifies, Name) + ") DO UPDATE SET " +
         Join(columns_, Updated, Excluded);
}

std::string TableSql::Update(std::string_view tail) const {
  return std::string("UPDATE ") + table_ + " SET " + Join(columns_, Updated, Assignment) + " " + std::string(tail);
}

}  // namespace dhpmap
