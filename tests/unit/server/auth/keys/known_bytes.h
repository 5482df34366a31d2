// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "server/auth/keys/key_text.h"

namespace dhpmap::auth {

/// 1, 2, 3, ...: every key differs, and each run is the same.
inline Randomness KnownBytes() {
  return [next = std::make_shared<unsigned char>(0)](std::span<unsigned char> bytes) {
    for (unsigned char& byte : bytes) byte = ++*next;
  };
}

}  // namespace dhpmap::auth
