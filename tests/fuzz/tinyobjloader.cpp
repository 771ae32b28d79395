// SPDX-License-Identifier: MIT
//
// tinyobjloader compiled with coverage and sanitizers; it takes the place of the library's.
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>
