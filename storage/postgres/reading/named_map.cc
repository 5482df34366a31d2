// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/reading/named_map.h"

#include <utility>

#include "storage/postgres/rows/part_rows.h"

namespace dhpmap::postgres {

Result<NamedMap> ReadNamedMap(Connection& connection, const std::string& name) {
  constexpr char kTask[] = "read the map";
  NamedMap map;
  Call call{&HeadByName()};
  call.values.Add(name);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kTask));
  if (!answer.Next()) return NoSuchMap(name);
  if (!ReadHead(answer, map.head)) return DamagedRows(name, "its row has a wrong checksum");
  Answers got = connection.Run(CallsForParts(map.head.row.key), kTask);
  if (!got.status.ok()) return got.status;
  Result<MapParts> parts = ReadParts(got.answers);
  const Status filled = parts.ok() ? FillInfo(map.head.row, *parts) : parts.status();
  if (filled.code() == StatusCode::kDataLoss) return DamagedRows(name, filled.message());
  DHPMAP_RETURN_IF_ERROR(filled);
  map.parts = std::move(parts).value();
  return map;
}

}  // namespace dhpmap::postgres
