// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clients/simulator/material.h"

// Materials of the apartment.
namespace dhpmap::simulator {

using Pattern = Material::Pattern;

inline constexpr Material kOak{Pattern::kWood, 0xc79b67, 0x9b6c3d, 0.35};
inline constexpr Material kWalnut{Pattern::kWood, 0x7d5638, 0x4d3220, 0.35};
inline constexpr Material kPine{Pattern::kWood, 0xe3c793, 0xc7a066, 0.45};
inline constexpr Material kFloorBoards{Pattern::kPlanks, 0xc9a273, 0xa17646, 0.16};
inline constexpr Material kBathTiles{Pattern::kTiles, 0xd6e3e4, 0x8fa3a6, 0.2};
inline constexpr Material kFloorTiles{Pattern::kChecker, 0xe9e4da, 0x7f8d94, 0.3};
inline constexpr Material kWallPaint{Pattern::kPlain, 0xefe9de};
inline constexpr Material kAccentPaint{Pattern::kPlain, 0x8fa9a3};
inline constexpr Material kBedroomPaint{Pattern::kPlain, 0xb9c4d6};
inline constexpr Material kStudyPaint{Pattern::kStripes, 0xf0e3c4, 0xe7d6ae, 0.12};
inline constexpr Material kCeilingPaint{Pattern::kPlain, 0xf7f5f0};
inline constexpr Material kWhite{Pattern::kPlain, 0xf2f1ec};
inline constexpr Material kEnamel{Pattern::kPlain, 0xfafafa};
inline constexpr Material kBlack{Pattern::kPlain, 0x1b1c1f};
inline constexpr Material kGraphite{Pattern::kPlain, 0x3a3d42};
inline constexpr Material kSteel{Pattern::kPlain, 0xb8bcc0};
inline constexpr Material kBrass{Pattern::kPlain, 0xc4a052};
inline constexpr Material kStone{Pattern::kMarble, 0x50545a, 0x8d9196, 0.3};
inline constexpr Material kMarble{Pattern::kMarble, 0xefece6, 0xa9a49c, 0.4};
inline constexpr Material kBlueCloth{Pattern::kWeave, 0x3f6487, 0x2c4864, 0.02};
inline constexpr Material kMustardCloth{Pattern::kWeave, 0xd9a13b, 0xb07c22, 0.02};
inline constexpr Material kGreyCloth{Pattern::kWeave, 0x9a9a97, 0x777773, 0.02};
inline constexpr Material kRedCloth{Pattern::kWeave, 0xb5473c, 0x8c2f28, 0.02};
inline constexpr Material kLinen{Pattern::kWeave, 0xf1ece1, 0xdcd3c3, 0.015};
inline constexpr Material kDuvet{Pattern::kStripes, 0x6b86a8, 0xe8e6df, 0.09};
inline constexpr Material kCurtainCloth{Pattern::kWeave, 0xe8d9c0, 0xcdb994, 0.03};
inline constexpr Material kTerracotta{Pattern::kPlain, 0xb5643c};
inline constexpr Material kSoil{Pattern::kSpeckles, 0x3a2a1d, 0x6a5038, 0.02};
inline constexpr Material kLeaf{Pattern::kSpeckles, 0x3f7d3a, 0x6fae58, 0.03};
inline constexpr Material kDarkLeaf{Pattern::kSpeckles, 0x2c5f38, 0x4b8a4d, 0.03};
inline constexpr Material kCardboard{Pattern::kSpeckles, 0xb98f5e, 0xa67d4d, 0.02};
inline constexpr Material kLampShade{Pattern::kWeave, 0xfff0d2, 0xffe6bb, 0.015, 0.75};
inline constexpr Material kLampGlass{Pattern::kPlain, 0xfff8ea, 0xffffff, 0.1, 1.6};
inline constexpr Material kWindowView{Pattern::kSky, 0xffffff, 0xffffff, 0.1, 0.9};
inline constexpr Material kScreen{Pattern::kLandscape, 0x2c4f86, 0x1d7a74, 0.1, 0.35};
inline constexpr Material kMirrorGlass{Pattern::kPlain, 0xaebfc7, 0xffffff, 0.1, 0.15};

/// A single colour.
constexpr Material Paint(std::uint32_t rgb) { return {Pattern::kPlain, rgb}; }

}  // namespace dhpmap::simulator
