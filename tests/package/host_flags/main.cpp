// SPDX-License-Identifier: MIT
#include "picture.hpp"

#include <mir/core/error.hpp>

#include <exception>
#include <iostream>

namespace {

/// Whether an error is the same type for the library that throws it and for this program.
bool is_caught() {
    try {
        fail();
    } catch (const mir::Error& e) {
        return e.code() == mir::ErrorCode::unsupported;
    }
    return false;
}

}  // namespace

/// Prints the fingerprints of the pictures; fails where values are not checked or an error is lost.
int main() {
    try {
        const std::string accepted = accepted_values();
        if (accepted.empty() && is_caught()) {
            std::cout << fingerprints() << '\n';
            return 0;
        }
        std::cerr << "taken without an error:\n" << accepted;
    } catch (const std::exception& e) {
        std::cerr << "not caught as it was thrown: " << e.what() << '\n';
    }
    return 1;
}
