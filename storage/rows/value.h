// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/base/transform.h"
#include "mapping/map/region.h"
#include "mapping/submap/bounding_sphere.h"
#include "mapping/submap/kept_outline.h"
#include "mapping/submap/sightings.h"
#include "mapping/submap/submap.h"
#include "storage/codec/bytes.h"
#include "storage/rows/parameters.h"

namespace dhpmap {

/// The types of columns of a STRICT table.
enum class SqlType { kInteger, kReal, kText, kBlob };
const char* SqlTypeName(SqlType type);

/// Representation of a C++ type in a column and under a checksum:
///   kType   the column's type
///   Bind    binds it as the statement's next parameter; text must live until the statement has run
///   Read    takes it from the row's next column; false if its value is of another type
///   Cover   appends its bytes for a checksum
template <typename T>
struct ColumnValue;

// Integers, and types that convert to one.

template <typename T>
requires(std::integral<T> || std::is_enum_v<T>) std::int64_t ToInteger(T value) {
  return static_cast<std::int64_t>(value);
}
template <typename T>
requires(std::integral<T> || std::is_enum_v<T>) T FromInteger(std::int64_t stored, std::type_identity<T>) {
  return static_cast<T>(stored);
}

template <typename Tag, typename Int>
std::int64_t ToInteger(StrongId<Tag, Int> id) {
  return ToInteger(id.value);
}
template <typename Tag, typename Int>
StrongId<Tag, Int> FromInteger(std::int64_t stored, std::type_identity<StrongId<Tag, Int>>) {
  return StrongId<Tag, Int>(static_cast<Int>(stored));
}

/// 0xRRGGBB.
std::int64_t ToInteger(Color color);
Color FromInteger(std::int64_t stored, std::type_identity<Color>);

template <typename T>
requires requires(T value) { ToInteger(value); }
struct ColumnValue<T> {
  static constexpr SqlType kType = SqlType::kInteger;
  static void Bind(T value, Parameters& parameters) { parameters.PutInt(ToInteger(value)); }
  static bool Read(RowColumns& columns, T& value) {
    const std::int64_t stored = columns.Int();
    value = FromInteger(stored, std::type_identity<T>());
    return ToInteger(value) == stored;
  }
  static void Cover(T value, ByteWriter& writer) { writer.PutU64(static_cast<std::uint64_t>(ToInteger(value))); }
};

template <>
struct ColumnValue<double> {
  static constexpr SqlType kType = SqlType::kReal;
  static void Bind(double value, Parameters& parameters) { parameters.PutReal(value); }
  static bool Read(RowColumns& columns, double& value) {
    value = columns.Real();
    return true;
  }
  static void Cover(double value, ByteWriter& writer) { writer.PutF64(value); }
};

template <>
struct ColumnValue<float> {
  static constexpr SqlType kType = SqlType::kReal;
  static void Bind(float value, Parameters& parameters) { parameters.PutReal(static_cast<double>(value)); }
  static bool Read(RowColumns& columns, float& value) {
    const double stored = columns.Real();
    value = static_cast<float>(stored);
    return static_cast<double>(value) == stored;
  }
  static void Cover(float value, ByteWriter& writer) { writer.PutF32(value); }
};

template <>
struct ColumnValue<std::string> {
  static constexpr SqlType kType = SqlType::kText;
  static void Bind(const std::string& value, Parameters& parameters) { parameters.PutText(value); }
  static bool Read(RowColumns& columns, std::string& value) {
    value = columns.Text();
    return true;
  }
  static void Cover(const std::string& value, ByteWriter& writer) { writer.PutText(value); }
};

// As little-endian bytes, exactly as in memory: SQLite's REAL turns -0.0 into 0 and NaN into NULL.

/// 12 doubles: the upper three rows of the matrix, row by row.
Bytes ToBytes(const Transform& T);
bool FromBytes(ByteView bytes, Transform& T);
/// 4 doubles: centre, radius.
Bytes ToBytes(const BoundingSphere& sphere);
bool FromBytes(ByteView bytes, BoundingSphere& sphere);
/// Empty if unknown (null). Else 3 doubles: the map's vertical; u8: whether there is an outline, and if so 7 doubles:
/// the box' centre, yaw and size; u8: whether it has a support height, and that as double; the number of corners of the
/// footprint as varint, and 2 doubles for each.
Bytes ToBytes(const std::shared_ptr<const LevelOutline>& outline);
/// Also false for numbers that are not finite.
bool FromBytes(ByteView bytes, std::shared_ptr<const LevelOutline>& outline);
/// u8: 0 = a box, then 6 doubles: its low and high corner; 1 = a sphere, then as above. Metres, map frame.
Bytes ToBytes(const Region& region);
bool FromBytes(ByteView bytes, Region& region);
/// Each class as u32, its count as u64.
Bytes ToBytes(const std::vector<ClassTotal>& counts);
bool FromBytes(ByteView bytes, std::vector<ClassTotal>& counts);
/// Each session as text, its track id as varint, whether it has the thing in sight as u8, frames missed and the number
/// of its last frame as varints.
Bytes ToBytes(const Sightings& sightings);
bool FromBytes(ByteView bytes, Sightings& sightings);

template <typename T>
requires requires(const T& value) {
  { ToBytes(value) } -> std::same_as<Bytes>;
}
struct ColumnValue<T> {
  static constexpr SqlType kType = SqlType::kBlob;
  static void Bind(const T& value, Parameters& parameters) { parameters.PutCopy(ToBytes(value)); }
  static bool Read(RowColumns& columns, T& value) { return FromBytes(columns.Blob(), value); }
  static void Cover(const T& value, ByteWriter& writer) { writer.PutBytes(ToBytes(value)); }
};

}  // namespace dhpmap
