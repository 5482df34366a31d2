// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "storage/codec/bytes.h"
#include "storage/codec/crc32c.h"
#include "storage/rows/value.h"
#include "storage/sqlite/statement.h"

namespace dhpmap {

/// When a column's value goes to the database.
enum class Written {
  kAlways,
  kOnce,       ///< with a new row: what the row is found by
  kElsewhere,  ///< not with its row: made by SQLite, or by a statement of its own
};

/// What the SQL text of a table follows from.
struct ColumnName {
  const char* name;
  SqlType type;
  Written written;
};

/// The text of statements that name every column of a table, in the order of the list.
class TableSql {
 public:
  TableSql(const char* table, std::vector<ColumnName> columns) : table_(table), columns_(std::move(columns)) {}

  [[nodiscard]] const char* table() const { return table_; }
  [[nodiscard]] const std::vector<ColumnName>& columns() const { return columns_; }

  /// All columns; `tail` is what follows the table's name: "WHERE map_key = ?".
  [[nodiscard]] std::string Select(std::string_view tail) const;
  /// All columns that are not written elsewhere.
  [[nodiscard]] std::string Insert() const;
  /// Insert that turns into an update of the row with the same values of kOnce, which must be unique together.
  [[nodiscard]] std::string Upsert() const;
  /// The columns that are always written.
  [[nodiscard]] std::string Update(std::string_view tail) const;

 private:
  const char* table_;
  std::vector<ColumnName> columns_;
};

/// A column, and where a Row keeps its value.
template <typename Row>
struct Column : ColumnName {
  int since;  ///< the first version of the checksum that covers it; 0 = none does
  void (*bind)(const Row& row, sqlite::Statement& statement);
  bool (*read)(sqlite::Columns& columns, Row& row);
  void (*cover)(const Row& row, ByteWriter& writer);
};

/// `access`: takes a Row (const or not) to the member; see DHPMAP_MEMBER.
template <typename Row, typename Access>
Column<Row> MakeColumn(const char* name, Written written, int since, Access) {
  using Value = ColumnValue<std::remove_cvref_t<std::invoke_result_t<Access, Row&>>>;
  return {{name, Value::kType, written},
          since,
          [](const Row& row, sqlite::Statement& statement) { Value::Bind(Access{}(row), statement); },
          [](sqlite::Columns& columns, Row& row) { return Value::Read(columns, Access{}(row)); },
          [](const Row& row, ByteWriter& writer) { Value::Cover(Access{}(row), writer); }};
}
#define DHPMAP_MEMBER(member) \
  [](auto& row) -> auto& { return row.member; }

/// What a row says of itself: its checksum, and which version of it.
struct RowSeal {
  int version = 0;
  std::uint32_t checksum = 0;
};

/// The one list of a table's columns: from it come SQL text, binding, reading and the checksum. Immutable.
///
/// The checksum has versions. Version v covers the columns with 1 <= since <= v, in the order of the list, so what a
/// row of an older version covered can still be computed: a new column goes to the end of the list, with the next
/// number.
template <typename Row>
class Table : public TableSql {
 public:
  Table(const char* table, std::vector<Column<Row>> columns)
      : TableSql(table, {columns.begin(), columns.end()}), columns_(std::move(columns)) {}

  /// The version of rows that are written now.
  [[nodiscard]] int version() const {
    int newest = 0;
    for (const Column<Row>& column : columns_) newest = std::max(newest, column.since);
    return newest;
  }

  /// Appends what version `version` of the checksum covers. From version 2 on the version itself comes first.
  void Cover(const Row& row, int version, Bytes& bytes) const {
    ByteWriter writer(bytes);
    if (version >= 2) writer.PutU32(static_cast<std::uint32_t>(version));
    for (const Column<Row>& column : columns_) {
      if (column.since >= 1 && column.since <= version) column.cover(row, writer);
    }
  }
  [[nodiscard]] std::uint32_t Checksum(const Row& row, int version) const {
    Bytes bytes;
    Cover(row, version, bytes);
    return Crc32c(bytes);
  }

  /// For Insert and Upsert.
  void BindAll(const Row& row, sqlite::Statement& statement) const {
    for (const Column<Row>& column : columns_) {
      if (column.written != Written::kElsewhere) column.bind(row, statement);
    }
  }
  /// For Update; the parameters of its tail come after.
  void BindChanges(const Row& row, sqlite::Statement& statement) const {
    for (const Column<Row>& column : columns_) {
      if (column.written == Written::kAlways) column.bind(row, statement);
    }
  }

  /// Reads the row that a Select is at; false if a column holds no value of its type.
  [[nodiscard]] bool Read(const sqlite::Statement& statement, Row& row) const {
    sqlite::Columns columns(statement);
    bool good = true;
    for (const Column<Row>& column : columns_) good = column.read(columns, row) && good;
    return good;
  }

  /// What a row that is written now is sealed with.
  [[nodiscard]] RowSeal SealOf(const Row& row) const { return {version(), Checksum(row, version())}; }
  /// Whether a row is as it was when it was sealed, by this version or an older one.
  [[nodiscard]] bool IsIntact(const Row& row, const RowSeal& seal) const {
    return seal.version >= 1 && seal.version <= version() && Checksum(row, seal.version) == seal.checksum;
  }

 private:
  std::vector<Column<Row>> columns_;
};

}  // namespace dhpmap
