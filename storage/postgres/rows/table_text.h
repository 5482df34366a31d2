// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "storage/rows/table.h"

namespace dhpmap::postgres {

// SQL texts from the column lists that both stores share. In PostgreSQL parameters are numbered, and columns that
// SQLite generates (Written::kElsewhere) are absent.

/// Columns that a table has after those of its list.
using MoreColumns = std::vector<std::string>;

/// All columns in the order of the list; `tail` follows the table's name.
std::string SelectText(const TableSql& table, std::string_view tail, const MoreColumns& more = {});
std::string InsertText(const TableSql& table, const MoreColumns& more = {});
/// An insert that updates the row with the same kOnce values, which are the table's key.
std::string UpsertText(const TableSql& table);
/// By its kOnce values.
std::string DeleteText(const TableSql& table);
/// "a = $1, b = $2": the columns that are always written, then `more`.
std::string AssignmentsText(const TableSql& table, const MoreColumns& more = {});

/// Binds the key of a row, for DeleteText.
template <typename Row>
void BindKey(const Table<Row>& table, const Row& row, Parameters& parameters) {
  for (const Column<Row>& column : table.list()) {
    if (column.written == Written::kOnce) column.bind(row, parameters);
  }
}

/// The bytes of a row, or of its key alone, for comparing rows.
template <typename Row>
std::string BytesOf(const Table<Row>& table, const Row& row, bool of_key) {
  Bytes bytes;
  ByteWriter writer(bytes);
  for (const Column<Row>& column : table.list()) {
    if (!of_key || column.written == Written::kOnce) column.cover(row, writer);
  }
  return {bytes.begin(), bytes.end()};
}

/// Reads a row of SelectText.
template <typename Row>
[[nodiscard]] bool ReadRow(const Table<Row>& table, RowColumns& columns, Row& row) {
  bool good = true;
  for (const Column<Row>& column : table.list()) {
    if (column.written != Written::kElsewhere) good = column.read(columns, row) && good;
  }
  return good;
}

}  // namespace dhpmap::postgres
