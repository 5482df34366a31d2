// SPDX-License-Identifier: BSD-3-Clause
#include "storage/store.h"

#include <iterator>
#include <utility>

namespace dhpmap {

StoredMap DamagedMap(const std::string& name, const Status& why) {
  StoredMap map;
  map.info.name = name;
  map.damage = why;
  return map;
}

Result<std::vector<StoredMap>> MapStore::ListMaps() {
  constexpr std::size_t kMapsAPage = 256;
  std::vector<StoredMap> maps;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(std::vector<StoredMap> page,
                            ListMaps(maps.empty() ? std::string() : maps.back().info.name, kMapsAPage));
    const bool is_last = page.size() < kMapsAPage;
    maps.insert(maps.end(), std::make_move_iterator(page.begin()), std::make_move_iterator(page.end()));
    if (is_last) return maps;
  }
}

Result<std::vector<std::string>> MapStore::ListMapNames(const std::string& after, std::size_t max) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<StoredMap> maps, ListMaps(after, max));
  std::vector<std::string> names;
  names.reserve(maps.size());
  for (const StoredMap& map : maps) names.push_back(map.info.name);
  return names;
}

}  // namespace dhpmap
