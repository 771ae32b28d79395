// SPDX-License-Identifier: MIT
#include "cuda/kernel_failure.hpp"

#include "cuda/experiments.hpp"
#include "mir/concepts/executor.hpp"
#include "mir/host/backend.hpp"
#include "support/catch.hpp"

#include <cstdio>
#include <filesystem>
#include <iostream>

namespace {

/// Runs `work` and prints how it ended.
template <class Work>
void report(const char* what, const Work& work) {
    try {
        work();
        std::cout << what << ": done\n";
    } catch (const mir::Error& e) {
        const bool is_device = e.code() == mir::ErrorCode::device;
        std::cout << what << (is_device ? ": Error(device): " : ": another Error: ") << e.what()
                  << '\n';
    }
}

/// What a command prints, and how it ends.
struct Output {
    std::string text;
    int status = -1;
};

Output run(const std::string& command) {
    Output output;
    FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    char line[512];
    while (std::fgets(line, sizeof line, pipe) != nullptr) output.text += line;
    output.status = pclose(pipe);
    return output;
}

}  // namespace

int mirtest::report_kernel_failure() {
    const mir::cuda::Backend backend(mir::cuda::select_device(0));
    report("kernel", [&] { write_where_nothing_is(backend); });
    report("copy", [&] {
        auto queue = backend.queue();
        queue.record().sync();
    });
    report("buffer", [&] { static_cast<void>(backend.buffer<std::uint32_t>(1u << 20)); });
    report("host", [] {
        mir::InlineExecutor executor;
        std::size_t wrong = 0;
        for (const auto& f : examine_backend(mir::host::Backend(executor))) wrong += f.wrong;
        if (wrong > 0) throw mir::Error(mir::ErrorCode::internal, "the host computes wrong");
    });
    return 0;
}

TEST_CASE("A kernel that fails is an error in words, and the process lives on without the GPU",
          "[kernel_failure]") {
    const auto self = std::filesystem::read_symlink("/proc/self/exe").string();
    const Output child = run("'" + self + "' " + std::string(mirtest::fail_in_kernel));
    INFO(child.text);
    CHECK(child.status == 0);
    CHECK(child.text.find("kernel: Error(device): ") != std::string::npos);
    CHECK(child.text.find("cudaErrorIllegalAddress") != std::string::npos);
    CHECK(child.text.find("start the program again") != std::string::npos);
    CHECK(child.text.find("copy: Error(device): ") != std::string::npos);
    CHECK(child.text.find("buffer: Error(device): ") != std::string::npos);
    CHECK(child.text.find("host: done") != std::string::npos);
}

TEST_CASE("After another program's kernel has failed the GPU is still there for this one",
          "[kernel_failure]") {
    const auto self = std::filesystem::read_symlink("/proc/self/exe").string();
    static_cast<void>(run("'" + self + "' " + std::string(mirtest::fail_in_kernel)));
    const mir::cuda::Backend backend(mir::cuda::select_device(0));
    for (const auto& [experiment, wrong] : mirtest::examine(backend)) {
        INFO(experiment);
        CHECK(wrong == 0);
    }
}
