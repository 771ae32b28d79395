// expect: WordCopyable
// SPDX-License-Identifier: MIT
#include "mir/data/soa.hpp"

struct Element {
#ifdef MIR_COMPILE_FAIL
    virtual float value() const { return x; }
#else
    float value() const { return x; }
#endif
    float x = 0.0f;
};

float read(std::uint32_t* planes) { return mir::SoaView<Element>{planes, 16}.load(3).value(); }
