// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace dhpmap::postgres {

// The statements around a transaction, as calls of a pipeline name them.
inline const std::string& BeginText() {
  static const std::string text = "BEGIN";
  return text;
}
inline const std::string& CommitText() {
  static const std::string text = "COMMIT";
  return text;
}

}  // namespace dhpmap::postgres
