// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "mapping/base/result.h"

namespace dhpmap {

/// One value a point.
struct CloudField {
  enum class Type { kUint16, kUint32, kFloat };
  const char* name = "";
  Type type = Type::kFloat;
};

/// Functions of libdhpmap_pcl.so, implemented with PCL. They return an error text, or nothing. Thread-safe.
struct CloudFiles {
  /// Header of a binary PCD file with these packed fields, in this order.
  std::string (*pcd_head)(std::span<const CloudField> fields, std::size_t num_points, std::string& head);
};

/// Loads the library at the first call. Errors as LoadSymbol. Thread-safe.
Result<const CloudFiles*> LoadCloudFiles();

}  // namespace dhpmap
