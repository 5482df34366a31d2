// SPDX-License-Identifier: BSD-3-Clause
#include "storage/codec/bytes.h"

namespace dhpmap {

// Never inlined: GCC 12 warns wrongly of overflows (its bug 105329 and similar).

[[gnu::noinline]] void ByteWriter::PutBytes(ByteView value) { bytes_.insert(bytes_.end(), value.begin(), value.end()); }

[[gnu::noinline]] void ByteWriter::PutText(std::string_view text) {
  PutVarint(text.size());
  bytes_.insert(bytes_.end(), text.begin(), text.end());
}

}  // namespace dhpmap
