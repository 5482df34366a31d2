// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace dhpmap {

/// An integer that cannot be mixed up with one of another meaning.
template <typename Tag, typename Int>
struct StrongId {
  using value_type = Int;
  Int value = 0;

  constexpr StrongId() = default;
  constexpr explicit StrongId(Int v) : value(v) {}
  constexpr auto operator<=>(const StrongId&) const = default;
  constexpr StrongId operator++(int) { return StrongId(value++); }
};

/// Id of a submap and of its instance: positive, unique in its map, never reused.
using SubmapId = StrongId<struct SubmapIdTag, std::uint32_t>;
/// Submap 0 holds geometry of unknown objects; it never holds labels.
inline constexpr SubmapId kUnknownSubmap{0};

/// A class of the map's label set.
using ClassId = StrongId<struct ClassIdTag, std::uint16_t>;

/// Id of a segment in one frame (a pixel or point value). 0 means no prediction. Without meaning across frames unless
/// the frame has persistent ids.
using SegmentId = StrongId<struct SegmentIdTag, std::uint32_t>;
inline constexpr SegmentId kNoSegment{0};

}  // namespace dhpmap

template <typename Tag, typename Int>
struct std::hash<dhpmap::StrongId<Tag, Int>> {
  std::size_t operator()(const dhpmap::StrongId<Tag, Int>& id) const noexcept { return std::hash<Int>{}(id.value); }
};
