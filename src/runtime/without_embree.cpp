// SPDX-License-Identifier: MIT
#include "runtime/traced_scenes.hpp"

const mir::EmbreeTracing* mir::embree_tracing() { return nullptr; }
