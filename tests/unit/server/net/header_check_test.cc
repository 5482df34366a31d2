// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/header_check.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/server/net/http2_bytes.h"

namespace dhpmap::net {
namespace {

/// The decision on a block in pieces of so many bytes; kNone only if the block is complete.
Refusal Check(const std::string& block, std::size_t piece_bytes) {
  HeaderCheck check;
  check.Begin();
  for (std::size_t at = 0; at < block.size(); at += piece_bytes) {
    const Refusal refusal = check.Add(std::string_view(block).substr(at, piece_bytes));
    if (refusal != Refusal::kNone) return refusal;
  }
  return check.is_between_fields() ? Refusal::kNone : Refusal::kBadHeader;
}

/// The same for pieces of any size.
Refusal CheckInPieces(const std::string& block) {
  const Refusal whole = Check(block, block.size() + 1);
  for (const std::size_t piece_bytes : {1, 2, 7}) EXPECT_EQ(Check(block, piece_bytes), whole) << piece_bytes;
  return whole;
}

TEST(HeaderCheck, AcceptsEveryRepresentationOfTheStandard) {
  const std::string long_value(300, 'v');
  EXPECT_EQ(CheckInPieces("\x82"), Refusal::kNone);                                 // indexed
  EXPECT_EQ(CheckInPieces("\x40\x03key\x05value"), Refusal::kNone);                 // kept, new name
  EXPECT_EQ(CheckInPieces("\x44\x05/path"), Refusal::kNone);                        // kept, known name
  EXPECT_EQ(CheckInPieces(std::string("\0\x03key\x05value", 11)), Refusal::kNone);  // not kept
  EXPECT_EQ(CheckInPieces("\x10\x03key\x05value"), Refusal::kNone);                 // never kept
  EXPECT_EQ(CheckInPieces("\x3f\xe1\x1f\x82"), Refusal::kNone);                     // table of 4096
  EXPECT_EQ(CheckInPieces("\x40\x81\x0f\x82\x0f\x0f"), Refusal::kNone);             // Huffman
  EXPECT_EQ(CheckInPieces("\x44\x7f\xad\x01" + long_value), Refusal::kNone);        // 127 + 45 + 128 bytes
  EXPECT_EQ(CheckInPieces(std::string("\x40\x03key\0", 6)), Refusal::kNone);        // empty value
  EXPECT_EQ(CheckInPieces(testing::CallFields("/dhpmap.v1.MapService/GetMap")), Refusal::kNone);
}

TEST(HeaderCheck, RefusesAValueOfTwoGibibytesByItsDeclaredLength) {
  EXPECT_EQ(CheckInPieces("\x44\x7f\xff\xff\xff\xff\x07"), Refusal::kBadHeader);
  EXPECT_EQ(CheckInPieces("\x44\x7f\x82\x7f"), Refusal::kBadHeader);                  // 16385
  EXPECT_EQ(CheckInPieces("\xff\xff\xff\xff\xff\x0f"), Refusal::kBadHeader);          // an index
  EXPECT_EQ(CheckInPieces("\x3f\xff\xff\xff\x7f"), Refusal::kBadHeader);              // a size of the table
  EXPECT_EQ(CheckInPieces("\x44\x7f\x80\x80\x80\x80\x80\x80"), Refusal::kBadHeader);  // zeros without end
}

TEST(HeaderCheck, RefusesTooManyFields) {
  EXPECT_EQ(CheckInPieces(std::string(256, '\x82')), Refusal::kNone);
  EXPECT_EQ(CheckInPieces(std::string(257, '\x82')), Refusal::kHeaderTooLarge);
}

TEST(HeaderCheck, KnowsThatABlockEndsWithinAField) {
  EXPECT_EQ(CheckInPieces("\x40\x03ke"), Refusal::kBadHeader);
  EXPECT_EQ(CheckInPieces("\x40\x03key"), Refusal::kBadHeader);
  EXPECT_EQ(CheckInPieces("\x44\x7f\x80"), Refusal::kBadHeader);
}

}  // namespace
}  // namespace dhpmap::net
