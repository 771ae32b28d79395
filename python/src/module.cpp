// SPDX-License-Identifier: MIT
//
// mir._core: the library for Python. What a user calls without an underscore lies in python/mir/.
#include "errors.hpp"
#include "mir/version.hpp"
#include "parts.hpp"
#include "render.hpp"
#include "result.hpp"
#include "scene.hpp"
#include "team.hpp"
#include "vpls.hpp"
#include "watch.hpp"

#include <nanobind/nanobind.h>

NB_MODULE(_core, m) {
    // The library never prints; what Python still holds at its end is freed by the system.
    nanobind::set_leak_warnings(false);
    mirpy::register_errors();
    m.attr("version") = mir::version;
    mirpy::bind_scene(m);
    mirpy::bind_vpls(m);
    mirpy::bind_result(m);
    mirpy::bind_watch(m);
    mirpy::bind_render(m);
    mirpy::bind_team(m);
    mirpy::bind_parts(m);
    mirpy::bind_gbuffer(m);
    mirpy::bind_compare(m);
}
