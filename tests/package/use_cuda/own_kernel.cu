// SPDX-License-Identifier: MIT
#include <mir/cuda/backend.cuh>

#include <iostream>
#include <vector>

namespace {

struct Square {
    std::uint32_t* out = nullptr;
    MIR_HD void operator()(std::uint32_t i) const { out[i] = i * i; }
};

std::uint32_t square_of_nine() {
    const mir::cuda::Backend backend(mir::cuda::select_device());
    auto there = backend.buffer<std::uint32_t>(10);
    std::vector<std::uint32_t> home(10);
    auto queue = backend.queue();
    queue.for_each(10, Square{there.data()});
    queue.download(there, std::span<std::uint32_t>(home));
    queue.sync();
    return home[9];
}

}  // namespace

int main() {
    try {
        const std::uint32_t square = square_of_nine();
        std::cout << "9 squared is " << square << '\n';
    } catch (const mir::Error& e) {
        std::cout << "no GPU: " << e.what() << '\n';
        return e.code() == mir::ErrorCode::no_device ? 0 : 1;
    }
}
