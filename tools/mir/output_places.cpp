// SPDX-License-Identifier: MIT
#include "output_places.hpp"

#include "mir/io/atomic_file.hpp"
#include "text.hpp"

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <set>
#include <system_error>

namespace mirtool {
namespace {

/// Device and number of what a name leads to, links followed. None where there is nothing.
std::optional<std::string> number_of(const std::filesystem::path& path) {
    struct stat found {};
    if (stat(path.c_str(), &found) != 0) return std::nullopt;
    return std::to_string(found.st_dev) + ":" + std::to_string(found.st_ino);
}

/// Equal for names that lead to one file, or would. One folder may have several names.
std::string identity_of(const std::string& name) {
    if (const auto file = number_of(name)) return *file;
    std::error_code failure;
    std::filesystem::path whole = std::filesystem::absolute(name, failure);
    if (failure) whole = name;
    if (const auto folder = number_of(whole.parent_path()))
        return *folder + "/" + whole.filename().string();
    const auto followed = std::filesystem::weakly_canonical(whole, failure);
    return (failure ? whole.lexically_normal() : followed).string();
}

}  // namespace

bool are_one_file(const std::string& a, const std::string& b) {
    return !a.empty() && !b.empty() && identity_of(a) == identity_of(b);
}

void check_output_places(const std::vector<std::string>& inputs,
                         const std::vector<std::string>& outputs, const std::string& job) {
    const std::string problem = ": it would replace another file of this " + job +
                                " (each needs a place of its own); give another name";
    std::set<std::string> taken;
    for (const std::string& name : inputs)
        if (!name.empty()) taken.insert(identity_of(name));
    for (const std::string& name : outputs) {
        if (name.empty()) continue;
        if (!taken.insert(identity_of(name)).second)
            throw mir::Error(mir::ErrorCode::invalid_argument, shown(name) + problem);
        const mir::AtomicFile writable(name);
    }
}

}  // namespace mirtool
