// SPDX-License-Identifier: MIT
#include "output_places.hpp"

#include "mir/io/atomic_file.hpp"

#include <filesystem>
#include <set>

namespace mirtool {

void check_output_places(const std::vector<std::string>& inputs,
                         const std::vector<std::string>& outputs, const std::string& job) {
    const auto place = [](const std::string& name) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(name));
    };
    const std::string problem = ": it would replace another file of this " + job +
                                " (each needs a place of its own); give another name";
    std::set<std::filesystem::path> taken;
    for (const std::string& name : inputs)
        if (!name.empty()) taken.insert(place(name));
    for (const std::string& name : outputs) {
        if (name.empty()) continue;
        if (!taken.insert(place(name)).second)
            throw mir::Error(mir::ErrorCode::invalid_argument, name + problem);
        const mir::AtomicFile writable(name);
    }
}

}  // namespace mirtool
