// SPDX-License-Identifier: MIT
#include <mir/cuda/backend.hpp>

#include <iostream>

int main() {
    try {
        for (const mir::cuda::Device& device : mir::cuda::devices())
            std::cout << device.ordinal << " " << device.name << '\n';
    } catch (const mir::Error& e) {
        std::cout << "no GPU: " << e.what() << '\n';
        return e.code() == mir::ErrorCode::no_device ? 0 : 1;
    }
}
