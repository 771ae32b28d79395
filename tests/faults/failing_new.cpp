// SPDX-License-Identifier: MIT
//
// operator new of the whole program.
#include "faults/failing_new.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

// NOLINTBEGIN(*-no-malloc, *-avoid-non-const-global-variables): there is nothing below it.
namespace {

thread_local std::uint64_t calls_left = 0;  // until one fails; 0: none does
thread_local bool has_struck = false;
thread_local std::size_t largest = 0;

bool is_in_embree(const void* code) {
    Dl_info info{};
    return dladdr(code, &info) != 0 && info.dli_fname != nullptr &&
           std::strstr(info.dli_fname, "libembree") != nullptr;
}

void* allocate(std::size_t size, std::size_t alignment, const void* caller) {
    largest = std::max(largest, size);
    if (calls_left > 0 && !is_in_embree(caller) && --calls_left == 0) {
        has_struck = true;
        throw std::bad_alloc();
    }
    const std::size_t wanted = std::max<std::size_t>(size, 1);
    void* memory =
        alignment <= alignof(std::max_align_t)
            ? std::malloc(wanted)
            : std::aligned_alloc(alignment, (wanted + alignment - 1) / alignment * alignment);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void* allocate_or_null(std::size_t size, std::size_t alignment, const void* caller) noexcept {
    try {
        return allocate(size, alignment, caller);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size, 1, __builtin_return_address(0)); }
void* operator new[](std::size_t size) { return allocate(size, 1, __builtin_return_address(0)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
// The address sanitizer has these of its own, and would miss its own delete.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return allocate_or_null(size, 1, __builtin_return_address(0));
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return allocate_or_null(size, 1, __builtin_return_address(0));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

// NOLINTEND(*-no-malloc, *-avoid-non-const-global-variables)

namespace mirtest {

AllocationFault::AllocationFault(std::uint64_t n) {
    has_struck = false;
    calls_left = n;
}
AllocationFault::~AllocationFault() { calls_left = 0; }
bool AllocationFault::struck() const { return has_struck; }

LargestAllocation::LargestAllocation() { largest = 0; }
std::size_t LargestAllocation::bytes() const { return largest; }

}  // namespace mirtest
