// SPDX-License-Identifier: BSD-3-Clause
#include "storage/codec/bytes.h"

namespace dhpmap {

// Never inlined: GCC 12 warns of overflows that are not there (its bug 105329 and kin).

[[gnu::noinline]] void ByteWriter::PutBytes(ByteView value) { bytes_.insert(bytes_.end(), value.begin(), value.end()); }

[[gnu::noinline]] void ByteWriter::PutText(std::string_view text) {
  PutVarint(text.size());
  bytes_.insert(bytes_.end(), text.begin(), text.end());
}

}  // namespace dhpmap
