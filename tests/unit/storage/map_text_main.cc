// SPDX-License-Identifier: BSD-3-Clause
// dhpmap_map_text [--digests] DATABASE: the contents of its maps as text, or digests of it, to go beside a released
// database.
#include <cstdio>
#include <string>
#include <string_view>

#include "storage/rows/config_rows.h"
#include "storage/rows/map_rows.h"
#include "storage/sqlite_store.h"
#include "storage/store.h"
#include "tests/unit/storage/map_digests.h"
#include "tests/unit/storage/map_text.h"

namespace dhpmap {
namespace {

Status Print(const std::string& path, bool only_digests) {
  DHPMAP_ASSIGN_OR_RETURN(const auto store, OpenSqliteStore(path, {.read_only = true}));
  DHPMAP_ASSIGN_OR_RETURN(auto database, sqlite::Database::Open(path, sqlite::OpenMode::kReadOnly, 1000));
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<std::string> names, ReadMapNames(database));
  for (const std::string& name : names) {
    DHPMAP_ASSIGN_OR_RETURN(const auto map, store->LoadMap(name));
    DHPMAP_ASSIGN_OR_RETURN(const MapRow row, ReadMapHead(database, name));
    DHPMAP_ASSIGN_OR_RETURN(const std::vector<ConfigRow> config, ReadConfigRows(database, row.key));
    const std::string text = testing::TextOf(*map) + testing::TextOf(config);
    std::fputs((only_digests ? testing::DigestsOf(text) : text).c_str(), stdout);
  }
  return Status::Ok();
}

}  // namespace
}  // namespace dhpmap

int main(int argc, char** argv) {
  const bool only_digests = argc == 3 && std::string_view(argv[1]) == "--digests";
  if (argc != 2 && !only_digests) {
    std::fprintf(stderr, "usage: dhpmap_map_text [--digests] DATABASE\n");
    return 2;
  }
  const dhpmap::Status printed = dhpmap::Print(argv[argc - 1], only_digests);
  if (!printed.ok()) std::fprintf(stderr, "%s\n", printed.ToString().c_str());
  return printed.ok() ? 0 : 1;
}
