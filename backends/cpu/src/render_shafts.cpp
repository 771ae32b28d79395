// SPDX-License-Identifier: MIT
#include "mir/host/shaft_scene.hpp"
#include "render_on_host.hpp"

template mir::RenderResult mir::cpu::render_any(const mir::cpu::HostRender&,
                                                const mir::ShaftScene&);
