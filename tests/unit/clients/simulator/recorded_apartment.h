// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "clients/simulator/apartment.h"

namespace dhpmap::testing {

inline const simulator::ApartmentScene& Apartment() {
  static const simulator::ApartmentScene scene;
  return scene;
}

inline std::string BytesOfFile(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace dhpmap::testing
