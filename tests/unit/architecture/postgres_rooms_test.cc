// SPDX-License-Identifier: BSD-3-Clause
// The rooms of the store on PostgreSQL, each of which includes lower ones only.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "tests/support/places.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

constexpr char kStore[] = "storage/postgres";

/// Of each room, the other rooms that it may include. All may include the files beside the rooms: connections.
const std::map<std::string, std::set<std::string>>& LowerRooms() {
  static const std::map<std::string, std::set<std::string>> rooms = {
      {"", {}},
      {"rows", {}},
      {"tiles", {}},
      {"reading", {"rows", "tiles"}},
      {"owners", {"rows", "reading", "fleet"}},
      {"fleet", {"rows", "owners"}},  // the one circle of rooms: a server takes maps, and maps are of servers
      {"auth", {"rows", "fleet"}},
      {"history", {"rows", "tiles", "reading"}},
      {"following", {"rows", "tiles", "reading"}},
      {"transit", {"rows", "tiles", "reading", "owners"}},
      {"check", {"rows", "tiles", "reading", "owners", "history"}},
      {"commit", {"rows", "tiles", "reading", "owners", "history", "transit"}},
  };
  return rooms;
}

/// "commit" of "storage/postgres/commit/writer.h"; empty for a file beside the rooms.
std::string RoomOfFile(const fs::path& file) {
  const fs::path inside = file.lexically_relative(kStore);
  return inside.has_parent_path() ? inside.begin()->string() : "";
}

TEST(Architecture, RoomsOfTheStoreOnPostgresIncludeLowerOnes) {
  const fs::path root = testing::SourceDir();
  const std::regex pattern(R"(^#include "(storage/postgres/[^"]+)\")");
  std::set<std::string> seen;
  for (const auto& entry : fs::recursive_directory_iterator(root / kStore)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cc") continue;
    const fs::path file = fs::relative(entry.path(), root);
    const std::string from = RoomOfFile(file);
    ASSERT_TRUE(LowerRooms().contains(from)) << file << " is in a room that is not listed";
    seen.insert(from);
    std::ifstream in(entry.path());
    std::smatch match;
    for (std::string line; std::getline(in, line);) {
      if (!std::regex_search(line, match, pattern)) continue;
      const std::string to = RoomOfFile(match[1].str());
      EXPECT_TRUE(to.empty() || to == from || LowerRooms().at(from).contains(to)) << file << ": " << line;
    }
  }
  EXPECT_EQ(seen.size(), LowerRooms().size()) << "a room is listed that has no file";
}

}  // namespace
}  // namespace dhpmap
