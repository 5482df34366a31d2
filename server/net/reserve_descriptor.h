// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap::net {

/// A file descriptor kept back, to accept one more connection when there are no others: a connection that nobody
/// accepts keeps its listener ready for ever. Not thread-safe.
class ReserveDescriptor {
 public:
  ReserveDescriptor() { Fill(); }
  ~ReserveDescriptor() { Use(); }
  ReserveDescriptor(const ReserveDescriptor&) = delete;
  ReserveDescriptor& operator=(const ReserveDescriptor&) = delete;

  /// Frees it; false if there was none.
  bool Use();
  /// Takes it back; false if there is none to be had.
  bool Fill();

 private:
  int descriptor_ = -1;
};

}  // namespace dhpmap::net
