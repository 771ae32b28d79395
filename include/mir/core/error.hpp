// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"
#include "mir/core/printable.hpp"

#include <cstdint>
#include <stdexcept>
#include <string>

namespace mir {

/// Place in the source that raised an error. clang 14 lacks std::source_location; the builtins used
/// here exist in every supported compiler and report the caller's line.
struct Where {
    const char* file = "";   ///< as the compiler was given it; static storage
    std::uint32_t line = 0;  ///< from 1; 0: unknown

    /// The caller's place, by its default arguments.
    MIR_HD static constexpr Where here(const char* file = __builtin_FILE(),
                                       std::uint32_t line = __builtin_LINE()) {
        return {file, line};
    }
};

/// What kind of failure an Error reports. `mir` the program maps these to exit codes.
enum class ErrorCode {
    invalid_argument,  ///< a value handed in by the caller cannot be used
    invalid_input,     ///< a file or scene cannot be read or breaks its format's rules
    limit_exceeded,    ///< a Limits bound would be passed; nothing was allocated
    unsupported,       ///< understood, but outside what this build or library does
    no_device,         ///< the requested device, or a denoiser, does not exist
    device,            ///< a device or its driver failed
    out_of_memory,     ///< a device has not enough memory; smaller tiles may help
    io,                ///< a file cannot be created or written
    cancelled,         ///< the caller asked to stop
    internal           ///< an invariant of the library broke: please report
};

/// The one exception type of the library. The message is a sentence: problem, reason, remedy. It is
/// printable(), whatever names of files and of things in them it quotes, and has 2000 bytes at
/// most.
class Error : public std::runtime_error {
 public:
    /// `what` is the message for users; `at` is the caller's place when left out.
    Error(ErrorCode code, const std::string& what, Where at = Where::here())
        : std::runtime_error(printable(what, 2000)), code_(code), where_(at) {}

    /// Kind of failure.
    [[nodiscard]] ErrorCode code() const noexcept { return code_; }
    /// Place in the library's source that raised it, for reports of bugs.
    [[nodiscard]] Where where() const noexcept { return where_; }

 private:
    ErrorCode code_;
    Where where_;
};

/// Checks a precondition at a public border, always, in every build.
/// @throws Error(invalid_argument) with `sentence` when `ok` is false.
inline void expects(bool ok, const char* sentence, Where at = Where::here()) {
    if (!ok) throw Error(ErrorCode::invalid_argument, sentence, at);
}

/// The same for functions that kernels share: checks on the host alone. Whoever starts a kernel has
/// checked what it is given.
/// @throws Error(invalid_argument) with `sentence` on the host when `ok` is false.
MIR_HD inline void expects_on_host([[maybe_unused]] bool ok, [[maybe_unused]] const char* sentence,
                                   [[maybe_unused]] Where at = Where::here()) {
#if !defined(__CUDA_ARCH__)
    expects(ok, sentence, at);
#endif
}

}  // namespace mir
