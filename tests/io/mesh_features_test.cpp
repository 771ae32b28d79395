// SPDX-License-Identifier: MIT
#include "io/features/mtl_keys.hpp"
#include "io/features/ply_elements.hpp"

using namespace mirtest;

TEST_CASE("every feature of OBJ files has its outcome") {
    features::check_all(features::obj_statements());
}

TEST_CASE("every feature of material libraries has its outcome") {
    features::check_all(features::mtl_keys());
}

TEST_CASE("every feature of PLY files has its outcome") {
    features::check_all(features::ply_elements());
}
