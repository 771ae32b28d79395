// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>

namespace mirtest {

/// What fake denoisers do as long as this lives, in programs that are started too.
struct Told {
    explicit Told(const char* word) { setenv("MIR_FAKE_OIDN", word, 1); }
    Told(const Told&) = delete;
    Told& operator=(const Told&) = delete;
    ~Told() { unsetenv("MIR_FAKE_OIDN"); }
};

}  // namespace mirtest
