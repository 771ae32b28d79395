// SPDX-License-Identifier: MIT
// The object that carries the precompiled headers of all test programs.
