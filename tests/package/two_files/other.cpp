// SPDX-License-Identifier: MIT
#include "everything.hpp"

std::size_t scenes_in_other_file();

std::size_t scenes_in_other_file() { return mir::builtin::scenes.size(); }
