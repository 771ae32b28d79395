// SPDX-License-Identifier: MIT
#include "read_picture.hpp"

#include "mir/io/exr.hpp"
#include "text.hpp"

#include <utility>

namespace mirtool {

Picture read_picture(const std::string& name, const std::string& layer) {
    try {
        mir::ExrImage file = mir::read_exr(name, layer);
        Picture picture{std::move(file.image)};
        for (const auto& [attribute, value] : file.vectors)
            if (attribute == "mir:origin") picture.origin = value;
        return picture;
    } catch (const mir::Error& e) {
        // A file that is too large is the input's fault, not that of the command line.
        if (e.code() != mir::ErrorCode::limit_exceeded) throw;
        throw mir::Error(mir::ErrorCode::invalid_input, shown(name) + ": " + e.what(), e.where());
    }
}

}  // namespace mirtool
