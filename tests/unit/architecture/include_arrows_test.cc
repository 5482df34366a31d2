// SPDX-License-Identifier: BSD-3-Clause
// The plan of the house, kept true: which room may include which, and where third-party headers may appear.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <vector>

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

/// Rooms, and the rooms that each may include besides itself. A room is the longest of these paths that a file is
/// below.
const std::map<std::string, std::vector<std::string>>& Arrows() {
  static const std::map<std::string, std::vector<std::string>> arrows = {
      {"mapping/base", {}},
      {"mapping/map", {"mapping/base"}},
      {"mapping/sensor", {"mapping/base", "mapping/map"}},
      {"mapping/fusion", {"mapping/base", "mapping/map", "mapping/sensor"}},
      {"mapping/tracking", {"mapping/base", "mapping/map", "mapping/sensor", "mapping/fusion"}},
      {"mapping/refinement", {"mapping/base", "mapping/map"}},
      {"mapping/query", {"mapping/base", "mapping/map"}},
      {"mapping/mesh", {"mapping/base", "mapping/map"}},
      {"mapping/io", {"mapping/base", "mapping/map", "mapping/mesh"}},
      {"mapping/pipeline",
       {"mapping/base", "mapping/map", "mapping/sensor", "mapping/fusion", "mapping/tracking", "mapping/refinement"}},
      {"storage", {"mapping/base", "mapping/map"}},
      {"server/log", {"mapping/base"}},
      {"server/app", {"mapping", "storage/store.h", "server/log"}},
      {"server/metrics", {"mapping/base", "server/app", "server/log"}},
      {"server/config", {"mapping/base", "mapping/map", "server/app", "server/log"}},
      {"server/ingest", {"mapping", "server/app", "server/log", "proto"}},
      {"server/grpc", {"mapping", "server/app", "server/ingest", "server/metrics", "server/log", "proto"}},
      {"server/rest", {"mapping/base", "server/app", "server/log", "proto"}},
      {"server", {"mapping", "storage/store.h", "server", "proto"}},  // main.cc: wiring
      {"clients/datasets", {"mapping"}},
      {"clients/simulator", {"mapping"}},
      {"clients/evaluator", {"mapping", "clients/datasets"}},
      {"clients/evaluator/baselines", {"mapping", "clients/evaluator/mapping_system.h"}},
      {"clients/cli", {"mapping/base", "mapping/map", "mapping/sensor", "clients/datasets", "proto"}},
  };
  return arrows;
}

/// Third-party headers, and the paths below which alone they may be included.
struct Fence {
  std::string header;
  std::vector<std::string> allowed;
  bool in_headers;  ///< whether our headers there may include it too
};
const std::vector<Fence>& Fences() {
  static const std::vector<Fence> fences = {
      {"sqlite3\\.h", {"storage/sqlite"}, false},
      {"grpcpp/|google/|dhpmap/v1/",
       {"server/grpc", "server/rest", "server/ingest", "server/main.cc", "clients/cli", "tests"},
       true},
      {"opencv2/", {"mapping/sensor", "clients/simulator", "clients/evaluator", "tests"}, false},
      {"nanoflann", {"clients/evaluator"}, false},
      {"pcl/", {"mapping/io", "tests"}, false},
      {"boost/", {"server/rest", "tests"}, false},
      {"yaml-cpp/", {"server/config", "tests"}, false},
      {"spdlog/", {"server/log"}, false},
      {"prometheus/", {"server/metrics"}, false},
  };
  return fences;
}

struct Include {
  std::string file;  ///< relative to the repository
  int line;
  std::string path;
};

const std::vector<Include>& AllIncludes() {
  static const std::vector<Include> includes = [] {
    std::vector<Include> found;
    const fs::path root(DHPMAP_SOURCE_DIR);
    const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
    for (const char* top : {"mapping", "storage", "server", "clients", "tests"}) {
      for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".h" && extension != ".cc") continue;
        std::ifstream in(entry.path());
        std::string text;
        for (int line = 1; std::getline(in, text); ++line) {
          std::smatch match;
          if (std::regex_search(text, match, pattern)) {
            found.push_back({fs::relative(entry.path(), root).string(), line, match[1].str()});
          }
        }
      }
    }
    return found;
  }();
  return includes;
}

bool IsBelow(const std::string& path, const std::string& room) {
  return path == room ||
         (path.size() > room.size() && path.compare(0, room.size(), room) == 0 && path[room.size()] == '/');
}

std::optional<std::string> RoomOf(const std::string& path) {
  std::optional<std::string> best;
  for (const auto& [room, allowed] : Arrows()) {
    if (IsBelow(path, room) && (!best || room.size() > best->size())) best = room;
  }
  return best;
}

TEST(Architecture, RoomsIncludeOnlyWhereTheirArrowsPoint) {
  for (const Include& include : AllIncludes()) {
    const std::optional<std::string> from = RoomOf(include.file);
    if (!from ||
        !(IsBelow(include.path, "mapping") || IsBelow(include.path, "storage") || IsBelow(include.path, "server") ||
          IsBelow(include.path, "clients") || IsBelow(include.path, "tests"))) {
      continue;
    }
    const auto& allowed = Arrows().at(*from);
    const bool is_allowed = IsBelow(include.path, *from) ||
                            std::any_of(allowed.begin(), allowed.end(),
                                        [&](const std::string& room) { return IsBelow(include.path, room); });
    EXPECT_TRUE(is_allowed) << include.file << ":" << include.line << " includes " << include.path;
  }
}

TEST(Architecture, ThirdPartyHeadersStayInTheirRooms) {
  for (const Fence& fence : Fences()) {
    const std::regex pattern("^(" + fence.header + ")");
    for (const Include& include : AllIncludes()) {
      if (!std::regex_search(include.path, pattern)) continue;
      const bool is_inside = std::any_of(fence.allowed.begin(), fence.allowed.end(),
                                         [&](const std::string& path) { return IsBelow(include.file, path); });
      EXPECT_TRUE(is_inside) << include.file << ":" << include.line << " includes " << include.path;
      const bool is_header = include.file.size() > 2 && include.file.compare(include.file.size() - 2, 2, ".h") == 0;
      if (is_header && !IsBelow(include.file, "tests")) {
        EXPECT_TRUE(fence.in_headers) << "header " << include.file << ":" << include.line << " includes "
                                      << include.path;
      }
    }
  }
}

TEST(Architecture, NoFileIsNamedForNothing) {
  const std::regex empty_name("^(utils?|common|helpers?|misc)$");
  const fs::path root(DHPMAP_SOURCE_DIR);
  for (const char* top : {"mapping", "storage", "server", "clients", "tests", "proto", "deploy"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      EXPECT_FALSE(std::regex_match(entry.path().stem().string(), empty_name)) << entry.path();
    }
  }
}

TEST(Architecture, NoSourceIsLongerThan500Lines) {
  const fs::path root(DHPMAP_SOURCE_DIR);
  for (const char* top : {"mapping", "storage", "server", "clients", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cc") continue;
      std::ifstream in(entry.path());
      EXPECT_LE(std::count(std::istreambuf_iterator<char>(in), {}, '\n'), 500) << entry.path();
    }
  }
}

}  // namespace
}  // namespace dhpmap
