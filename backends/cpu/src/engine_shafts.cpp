// SPDX-License-Identifier: MIT
#include "host_engine.hpp"
#include "mir/host/shaft_scene.hpp"

template class mir::cpu::HostEngineOf<mir::ShaftScene>;
