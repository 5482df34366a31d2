// SPDX-License-Identifier: BSD-3-Clause
// dhpmap_map_text DATABASE: the contents of its maps as text, to go beside a released database.
#include <cstdio>

#include "storage/rows/config_rows.h"
#include "storage/rows/map_rows.h"
#include "storage/store.h"
#include "tests/unit/storage/map_text.h"

namespace dhpmap {
namespace {

Status Print(const std::string& path) {
  DHPMAP_ASSIGN_OR_RETURN(const auto store, OpenSqliteStore(path, {.read_only = true}));
  DHPMAP_ASSIGN_OR_RETURN(auto database, sqlite::Database::Open(path, sqlite::OpenMode::kReadOnly, 1000));
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<std::string> names, ReadMapNames(database));
  for (const std::string& name : names) {
    DHPMAP_ASSIGN_OR_RETURN(const auto map, store->LoadMap(name));
    DHPMAP_ASSIGN_OR_RETURN(const MapRow row, ReadMapHead(database, name));
    DHPMAP_ASSIGN_OR_RETURN(const std::vector<ConfigRow> config, ReadConfigRows(database, row.key));
    std::fputs(testing::TextOf(*map).c_str(), stdout);
    for (const ConfigRow& entry : config) std::printf("config %s = %s\n", entry.key.c_str(), entry.value.c_str());
  }
  return Status::Ok();
}

}  // namespace
}  // namespace dhpmap

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: dhpmap_map_text DATABASE\n");
    return 2;
  }
  const dhpmap::Status printed = dhpmap::Print(argv[1]);
  if (!printed.ok()) std::fprintf(stderr, "%s\n", printed.ToString().c_str());
  return printed.ok() ? 0 : 1;
}
