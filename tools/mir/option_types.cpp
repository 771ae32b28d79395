// SPDX-License-Identifier: MIT
#include "option_types.hpp"

namespace mirtool {

CLI::Validator between(double low, double high, const std::string& text) {
    return {[=](std::string& value) {
                double number = 0.0;
                if (!CLI::detail::lexical_cast(value, number))
                    return "'" + value + "' is no number";
                if (number >= low && number <= high) return std::string();
                return value + " is out of range; give " + text;
            },
            text};
}

CLI::Validator seed_number() {
    return {[](std::string& value) {
                std::uint64_t number = 0;
                if (read_whole(value, number)) return std::string();
                return "'" + value + "' is no seed; give 0 to 18446744073709551615";
            },
            "0 to 2^64-1"};
}

}  // namespace mirtool
