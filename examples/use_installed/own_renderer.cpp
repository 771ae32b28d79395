// SPDX-License-Identifier: MIT
//
// A renderer that has rays and surfaces of its own and takes from mir what gathers the light of
// virtual point lights. Here its world is one white floor below one VPL, with nothing in between.
#include <mir/mir.hpp>

#include <iostream>

namespace {

/// The ray tracing of this renderer; models mir's concept Visibility.
struct OpenAir {
    static constexpr mir::Space space = mir::Space::host;

    [[nodiscard]] bool visible(mir::Vec3 /*a*/, mir::Vec3 /*b*/) const { return true; }
};

constexpr mir::Extent floor_size{32, 32};

/// The floor, 3.2 m wide, as one luxel per 0.1 m, seen from straight above.
mir::BlockedGBuffer<mir::Lambert::Params> floor_luxels() {
    mir::BlockedGBuffer<mir::Lambert::Params> luxels(floor_size, floor_size);
    const auto layout = mir::BlockedLayout::of(luxels.tiles()[0]);
    const mir::Vec3 up(0, 1, 0);
    for (std::uint32_t y = 0; y < floor_size.height; ++y)
        for (std::uint32_t x = 0; x < floor_size.width; ++x) {
            const mir::Vec3 at(0.1f * (static_cast<float>(x) - 15.5f), 0.0f,
                               0.1f * (static_cast<float>(y) - 15.5f));
            luxels.store(0, layout(x, y), {at, up}, {up, up, {}, {{0.8f, 0.8f, 0.8f}}});
        }
    return luxels;
}

}  // namespace

int main() {
    const auto luxels = floor_luxels();
    mir::VplList vpls;
    vpls.push_back({{0, 1, 0}, {0, -1, 0}, {1, 1, 1}}, {});

    mir::InlineExecutor here;
    const mir::Image<mir::Rgb> radiance = reconstruct(mir::sched::Cpu{here}, luxels, vpls.span(),
                                                      OpenAir{}, mir::VplShading<mir::Lambert>{});
    std::cout << "below the VPL " << radiance(16, 16).g << ", in the corner " << radiance(0, 0).g
              << " W/(m^2 sr)\n";
}
