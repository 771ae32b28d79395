// SPDX-License-Identifier: MIT
#pragma once

// Catch2 2.13 (Debian 12) and 3.x from one include.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
namespace mirtest {
using Catch::Approx;
}
#else
#include <catch2/catch.hpp>
namespace mirtest {
using Catch::Detail::Approx;
}
#endif
