// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "exit_code.hpp"
#include "mir/runtime/all_renderers.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace mirtool {
namespace {

using Json = nlohmann::ordered_json;

void print_json(const mir::DeviceList& list) {
    Json devices = Json::array();
    for (const mir::DeviceReport& d : list.devices) {
        Json device{{"name", d.name}, {"threads", d.threads}, {"description", d.description}};
        if (d.memory > 0) device["memory_bytes"] = d.memory;
        devices.push_back(device);
    }
    const Json out{{"devices", devices}, {"unavailable", list.unavailable}};
    std::printf("%s\n", out.dump(2).c_str());
}

void print_text(const mir::DeviceList& list) {
    for (const mir::DeviceReport& d : list.devices) {
        const bool is_cpu = d.name == "cpu";
        std::printf("%s: %u %s, %s", d.name.c_str(), d.threads,
                    is_cpu ? "threads" : "multiprocessors", d.description.c_str());
        if (d.memory > 0) std::printf(", %.1f GB", 1e-9 * static_cast<double>(d.memory));
        std::printf("\n");
    }
    for (const std::string& why : list.unavailable) std::printf("%s\n", why.c_str());
}

}  // namespace

int run(const DevicesOptions& options) {
    const mir::DeviceList list = mir::list_devices();
    if (options.json)
        print_json(list);
    else
        print_text(list);
    return exit_done;
}

}  // namespace mirtool
