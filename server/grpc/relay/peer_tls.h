// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace dhpmap {

/// How to reach other servers of a fleet: PEM files; new calls use renewed ones.
struct PeerTls {
  bool is_on = false;
  std::string ca;         ///< who signs the servers' certificates; empty: whom this system trusts
  std::string cert, key;  ///< shown to servers that ask for them; empty: none
};

}  // namespace dhpmap
