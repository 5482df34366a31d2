// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/value.h"

#include <utility>

namespace dhpmap {

const char* SqlTypeName(SqlType type) {
  switch (type) {
    case SqlType::kInteger: return "INTEGER";
    case SqlType::kReal: return "REAL";
    case SqlType::kText: return "TEXT";
    case SqlType::kBlob: return "BLOB";
  }
  return "";
}

std::int64_t ToInteger(Color color) { return (std::int64_t{color.r} << 16) | (std::int64_t{color.g} << 8) | color.b; }

Color FromInteger(std::int64_t stored, std::type_identity<Color>) {
  return {static_cast<std::uint8_t>(stored >> 16), static_cast<std::uint8_t>(stored >> 8),
          static_cast<std::uint8_t>(stored)};
}

Bytes ToBytes(const Transform& T) {
  Bytes bytes;
  ByteWriter writer(bytes);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) writer.PutF64(T.matrix()(row, column));
  }
  return bytes;
}

bool FromBytes(ByteView bytes, Transform& T) {
  ByteReader reader(bytes);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) T.matrix()(row, column) = reader.GetF64();
  }
  return reader.ok() && reader.remaining() == 0;
}

Bytes ToBytes(const BoundingSphere& sphere) {
  Bytes bytes;
  ByteWriter writer(bytes);
  for (const double value : {sphere.center_m.x(), sphere.center_m.y(), sphere.center_m.z(), sphere.radius_m}) {
    writer.PutF64(value);
  }
  return bytes;
}

bool FromBytes(ByteView bytes, BoundingSphere& sphere) {
  ByteReader reader(bytes);
  for (double* value : {&sphere.center_m.x(), &sphere.center_m.y(), &sphere.center_m.z(), &sphere.radius_m}) {
    *value = reader.GetF64();
  }
  return reader.ok() && reader.remaining() == 0;
}

Bytes ToBytes(const std::vector<ClassTotal>& counts) {
  Bytes bytes;
  ByteWriter writer(bytes);
  for (const ClassTotal& entry : counts) {
    writer.PutU32(entry.id.value);
    writer.PutU64(entry.count);
  }
  return bytes;
}

bool FromBytes(ByteView bytes, std::vector<ClassTotal>& counts) {
  counts.clear();
  ByteReader reader(bytes);
  while (reader.remaining() > 0) {
    const std::uint32_t id = reader.GetU32();
    if (!std::in_range<std::uint16_t>(id)) return false;
    counts.push_back({ClassId(static_cast<std::uint16_t>(id)), reader.GetU64()});
  }
  return reader.ok();
}

}  // namespace dhpmap
