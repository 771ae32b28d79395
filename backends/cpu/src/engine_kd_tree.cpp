// SPDX-License-Identifier: MIT
#include "host_engine.hpp"
#include "mir/accel/kd/kd_tree_scene.hpp"

template class mir::cpu::HostEngineOf<mir::KdTreeScene>;
