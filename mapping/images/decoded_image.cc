// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/images/decoded_image.h"

#include <iterator>

namespace dhpmap {

std::string ToString(SampleType type) {
  constexpr const char* kNames[] = {"uint8", "int8", "uint16", "int16", "int32", "float", "double", "half"};
  const auto number = static_cast<std::size_t>(type);
  return number < std::size(kNames) ? kNames[number] : "unknown";
}

}  // namespace dhpmap
