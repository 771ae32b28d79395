// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

namespace mirpaper {

// What Pajot, Barthe and Paulin report in section 6 (2009): a Core 2 Duo at 3 GHz and a GTX 280,
// 1600 x 1200 luxels, 256 VPLs and tiles of 256 x 256 unless a figure says otherwise.

/// A time of figures 8, 9 or 11, in seconds.
struct PaperTime {
    std::string_view figure;
    std::string_view scene;
    std::string_view algorithm;
    std::string_view tile;
    double seconds = 0.0;
};

/// A rate of figure 10, in contributions per second.
struct PaperRate {
    std::string_view scene;
    double contributions = 0.0;
};

inline constexpr std::array<PaperTime, 21> paper_times{{
    {"8", "sphere", "cpu", "256x256", 200.0},
    {"8", "sphere", "os", "256x256", 247.0},
    {"8", "sphere", "rc", "256x256", 5.0},
    {"8", "sphere", "rcvp", "256x256", 3.0},
    {"9", "sphere", "rc", "256x256", 5.0},
    {"9", "sphere-indirect", "rc", "256x256", 5.0},
    {"9", "car", "rc", "256x256", 17.0},
    {"9", "car-indirect", "rc", "256x256", 17.0},
    {"9", "car-grille", "rc", "256x256", 44.0},
    {"9", "car-grille-indirect", "rc", "256x256", 23.0},
    {"9", "sphere", "rcvp", "256x256", 3.0},
    {"9", "sphere-indirect", "rcvp", "256x256", 5.0},
    {"9", "car", "rcvp", "256x256", 12.0},
    {"9", "car-indirect", "rcvp", "256x256", 12.0},
    {"9", "car-grille", "rcvp", "256x256", 31.0},
    {"9", "car-grille-indirect", "rcvp", "256x256", 17.0},
    {"11", "car", "rcvp", "100x100", 15.0},
    {"11", "car", "rcvp", "100x256", 14.0},
    {"11", "car", "rcvp", "256x256", 12.0},
    {"11", "car", "rcvp", "512x256", 15.0},
    {"11", "car", "rcvp", "512x512", 15.0},
}};

inline constexpr std::array<PaperRate, 3> paper_rates{
    {{"sphere", 196e6}, {"car", 45e6}, {"garage", 140e6}}};

/// 0 where the paper has no such time.
constexpr double paper_seconds(std::string_view figure, std::string_view scene,
                               std::string_view algorithm, std::string_view tile) {
    for (const PaperTime& t : paper_times)
        if (t.figure == figure && t.scene == scene && t.algorithm == algorithm && t.tile == tile)
            return t.seconds;
    return 0.0;
}

/// The peak of figure 10, 0 where the paper has none.
constexpr double paper_peak(std::string_view scene) {
    for (const PaperRate& r : paper_rates)
        if (r.scene == scene) return r.contributions;
    return 0.0;
}

}  // namespace mirpaper
