// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/reading/head_reader.h"

#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {

Result<MapHead> ReadHeadOf(Connection& connection, const std::string& name) {
  Call call{&HeadByName()};
  call.values.Add(name);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, "read the map"));
  if (!answer.Next()) return NoSuchMap(name);
  MapHead head;
  if (!ReadHead(answer, head)) return DamagedRows(name, "its row has a wrong checksum");
  return head;
}

}  // namespace dhpmap::postgres
