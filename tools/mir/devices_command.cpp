// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "exit_code.hpp"
#include "mir/cpu/register.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <thread>

namespace mirtool {

int run(const DevicesOptions& options) {
    const unsigned threads = std::thread::hardware_concurrency();
    const std::string description = mir::cpu::description();
    if (options.json) {
        const nlohmann::ordered_json device{
            {"name", "cpu"}, {"threads", threads}, {"description", description}};
        std::printf("%s\n", nlohmann::ordered_json{{"devices", {device}}}.dump(2).c_str());
    } else {
        std::printf("cpu: %u threads, %s\n", threads, description.c_str());
    }
    return exit_done;
}

}  // namespace mirtool
