// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/tiles/commit_places.h"

#include <bit>
#include <limits>

#include "storage/codec/crc32c.h"

namespace dhpmap::postgres {
namespace {

constexpr std::uint64_t kRowChanged = 1, kEmptied = 2;
constexpr std::size_t kChecksum_bytes = 4;

std::uint64_t ZigZag(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}
std::int64_t UnZigZag(std::uint64_t word) {
  return static_cast<std::int64_t>(word >> 1) ^ -static_cast<std::int64_t>(word & 1);
}

Status Damaged() { return DataLoss("the places of a commit are damaged"); }

/// Moves a coordinate by its distance from that of the previous tile. False: out of range.
bool Advance(std::int32_t& coordinate, std::int64_t by) {
  constexpr std::int64_t kMost = std::int64_t{1} << 33;
  if (by < -kMost || by > kMost) return false;
  const std::int64_t next = coordinate + by;
  coordinate = static_cast<std::int32_t>(next);
  return next == coordinate;
}

}  // namespace

void CommitPlaces::Empty(std::int64_t owner) {
  Owner& places = owners_[owner];
  places.is_emptied = true;
  places.tiles.clear();
}

std::size_t CommitPlaces::NumTileRows() const {
  std::size_t num_rows = 0;
  for (const auto& owner : owners_) {
    for (const auto& tile : owner.second.tiles) num_rows += static_cast<std::size_t>(std::popcount(tile.second));
  }
  return num_rows;
}

Bytes CommitPlaces::Encode() const {
  Bytes bytes;
  ByteWriter out(bytes);
  out.PutVarint(owners_.size());
  for (const auto& [owner, places] : owners_) {
    out.PutVarint(ZigZag(owner));
    out.PutVarint((places.is_row_changed ? kRowChanged : 0) | (places.is_emptied ? kEmptied : 0));
    out.PutVarint(places.tiles.size());
    std::array<std::int32_t, 3> last{};
    for (const auto& [index, layers] : places.tiles) {
      for (std::size_t axis = 0; axis < 3; ++axis) out.PutVarint(ZigZag(std::int64_t{index[axis]} - last[axis]));
      out.PutVarint(layers);
      last = index;
    }
  }
  out.PutU32(Crc32c(bytes));
  return bytes;
}

Status CommitPlaces::Add(ByteView encoded) {
  if (encoded.size() < kChecksum_bytes) return Damaged();
  const ByteView body = encoded.first(encoded.size() - kChecksum_bytes);
  ByteReader checksum(encoded.last(kChecksum_bytes));
  if (checksum.GetU32() != Crc32c(body)) return Damaged();
  ByteReader in(body);
  for (std::uint64_t num_owners = in.GetVarint(); num_owners > 0 && in.ok(); --num_owners) {
    const std::int64_t owner = UnZigZag(in.GetVarint());
    const std::uint64_t flags = in.GetVarint();
    if ((flags & kEmptied) != 0) Empty(owner);
    Owner& places = owners_[owner];
    places.is_row_changed |= (flags & kRowChanged) != 0;
    std::array<std::int32_t, 3> index{};
    for (std::uint64_t num_tiles = in.GetVarint(); num_tiles > 0 && in.ok(); --num_tiles) {
      for (std::int32_t& coordinate : index) {
        if (!Advance(coordinate, UnZigZag(in.GetVarint()))) return Damaged();
      }
      places.tiles[index] |= static_cast<std::uint32_t>(in.GetVarint());
    }
  }
  return in.ok() && in.remaining() == 0 ? Status::Ok() : Damaged();
}

}  // namespace dhpmap::postgres
