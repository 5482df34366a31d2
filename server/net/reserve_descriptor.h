// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap::net {

/// A reserved file descriptor, to accept one more connection when there are no others: a pending connection that is not
/// accepted keeps its listener ready for ever. Not thread-safe.
class ReserveDescriptor {
 public:
  ReserveDescriptor() { Fill(); }
  ~ReserveDescriptor() { Use(); }
  ReserveDescriptor(const ReserveDescriptor&) = delete;
  ReserveDescriptor& operator=(const ReserveDescriptor&) = delete;

  /// Frees it; false if it was not reserved.
  bool Use();
  /// Reserves one again; false if none is available.
  bool Fill();

 private:
  int descriptor_ = -1;
};

}  // namespace dhpmap::net
