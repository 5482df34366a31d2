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

/// What libdhpmap_pcl.so does with PCL. Says what is wrong, or nothing. Thread-safe.
struct CloudFiles {
  /// Head of a binary PCD file whose points have these fields, packed, in this order.
  std::string (*pcd_head)(std::span<const CloudField> fields, std::size_t num_points, std::string& head);
};

/// Loads it, the first time. Errors as LoadSymbol. Thread-safe.
Result<const CloudFiles*> LoadCloudFiles();

}  // namespace dhpmap
