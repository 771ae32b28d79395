// expect: is_const_v
// SPDX-License-Identifier: MIT
#include "mir/data/soa.hpp"

#ifdef MIR_COMPILE_FAIL
using Element = const float;
#else
using Element = float;
#endif

void write(std::uint32_t* planes) { mir::SoaView<Element>{planes, 16}.store(3, 1.0f); }
