// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "storage/store.h"

namespace dhpmap::testing {

inline std::string AllOf(StoreBackup& file) {
  std::string bytes;
  for (;;) {
    const auto piece = file.Read(10'000);
    EXPECT_TRUE(piece.ok());
    if (!piece.ok() || piece->empty()) return bytes;
    bytes += *piece;
  }
}

/// A map's file; empty after an error.
inline std::string Export(MapStore& store, const std::string& name) {
  const auto file = store.ExportMap(name, {});
  EXPECT_TRUE(file.ok()) << file.status().ToString();
  return file.ok() ? AllOf(**file) : "";
}

/// `name`: empty for the one in the file. Returns the one that it has.
inline Result<std::string> Import(MapStore& store, const std::string& bytes, const std::string& name = "") {
  auto import = store.ImportMap();
  if (!import.ok()) return import.status();
  for (std::size_t at = 0; at < bytes.size(); at += 7'000) {
    DHPMAP_RETURN_IF_ERROR((*import)->Write(std::string_view(bytes).substr(at, 7'000)));
  }
  DHPMAP_ASSIGN_OR_RETURN(std::string new_name, (*import)->LookThrough({}));
  if (!name.empty()) new_name = name;
  DHPMAP_RETURN_IF_ERROR((*import)->Bring({}));
  DHPMAP_RETURN_IF_ERROR((*import)->Add(new_name));
  return new_name;
}

}  // namespace dhpmap::testing
