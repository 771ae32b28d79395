// SPDX-License-Identifier: MIT
#include "read_picture.hpp"

#include "mir/io/exr.hpp"

namespace mirtool {

mir::Image<mir::Rgb> read_picture(const std::string& name, const std::string& layer) {
    try {
        return mir::read_exr(name, layer).image;
    } catch (const mir::Error& e) {
        // A file that is too large is the input's fault, not that of the command line.
        if (e.code() != mir::ErrorCode::limit_exceeded) throw;
        throw mir::Error(mir::ErrorCode::invalid_input, name + ": " + e.what(), e.where());
    }
}

}  // namespace mirtool
