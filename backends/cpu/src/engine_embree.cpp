// SPDX-License-Identifier: MIT
#include "host_engine.hpp"
#include "mir/cpu/embree_scene.hpp"

template class mir::cpu::HostEngineOf<mir::cpu::EmbreeScene>;
