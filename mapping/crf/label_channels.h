// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mapping/base/refinement_scratch.h"

namespace dhpmap {

/// Packs the labels of one kind into channels of the CRF: labels that nowhere occur within reach of one another share a
/// channel, since no voxel can confuse them. A room has dozens of objects but only few in each neighbourhood, and time
/// and memory of the CRF are linear in the channels. Call Add, then Assign, then the queries. Thread-compatible.
class LabelChannels {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  /// Places are numbered from 0 to num_places - 1.
  explicit LabelChannels(std::size_t num_places = 0) : num_places_(num_places) {}

  /// A voxel at this place has the label. Repetition changes nothing.
  void Add(std::uint32_t place, std::uint32_t label) { seen_.emplace_back(place, label); }

  /// Gives every label the lowest channel that no label within its reach has; labels at most places choose first (ties:
  /// the smaller). `neighbours[place]`: the places within reach, itself included; the relation is symmetric.
  void Assign(std::span<const std::vector<std::uint32_t>> neighbours);

  [[nodiscard]] int num_channels() const { return num_channels_; }
  /// The label must have been added.
  [[nodiscard]] std::uint32_t ChannelOf(std::uint32_t label) const { return channel_[NumberOf(label)]; }
  /// The label of a channel at a place; kNone if none of its labels occurs within reach.
  [[nodiscard]] std::uint32_t LabelAt(std::uint32_t place, std::uint32_t channel) const {
    return label_at_[static_cast<std::size_t>(place) * static_cast<std::size_t>(num_channels_) + channel];
  }

 private:
  [[nodiscard]] std::size_t NumberOf(std::uint32_t label) const;

  std::size_t num_places_;
  int num_channels_ = 0;
  ScratchVector<std::pair<std::uint32_t, std::uint32_t>> seen_;  ///< place and label
  std::vector<std::uint32_t> labels_;                            ///< ascending
  std::vector<std::uint32_t> channel_;                           ///< one a label
  ScratchVector<std::uint32_t> label_at_;                        ///< by place, then channel
};

}  // namespace dhpmap
