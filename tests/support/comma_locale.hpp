// SPDX-License-Identifier: MIT
#pragma once

#include "support/temporary_folder.hpp"

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <locale>
#include <optional>
#include <string>

namespace mirtest {

/// Writes 1.234,5 where others write 1234.5.
class CommaDigits : public std::numpunct<char> {
    [[nodiscard]] char do_decimal_point() const override { return ','; }
    [[nodiscard]] char do_thousands_sep() const override { return '.'; }
    [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};

/// While it exists the program counts as in Germany: C++ streams always, C functions where the
/// machine has such a locale or can make one. The program has no other threads meanwhile.
class CommaLocale {
 public:
    CommaLocale() : of_cpp_(std::locale::global({std::locale(), new CommaDigits})) {
        const char* const named = std::setlocale(LC_ALL, nullptr);
        of_c_ = named == nullptr ? "C" : named;
        if (!is_set("de_DE.UTF-8") && !is_set("de_DE.utf8") && !is_made())
            std::setlocale(LC_ALL, of_c_.c_str());
    }
    CommaLocale(const CommaLocale&) = delete;
    CommaLocale& operator=(const CommaLocale&) = delete;
    ~CommaLocale() {
        std::setlocale(LC_ALL, of_c_.c_str());
        std::locale::global(of_cpp_);
    }

    /// Whether C functions write a comma, too.
    [[nodiscard]] static bool is_of_c() {
        char text[8];
        std::snprintf(text, sizeof text, "%.1f", 0.5);
        return std::strcmp(text, "0,5") == 0;
    }

 private:
    static bool is_set(const char* name) { return std::setlocale(LC_ALL, name) != nullptr; }

    /// Makes the locale in a folder of its own, where the C library finds it by LOCPATH.
    bool is_made() {
        folder_.emplace("locale");
        const std::string path = (*folder_ / "de_DE.UTF-8").string();
        const std::string make = "localedef -i de_DE -f UTF-8 '" + path + "' >/dev/null 2>&1";
        if (std::system(make.c_str()) != 0) return false;  // NOLINT(*-command-processor, cert-*)
        setenv("LOCPATH", (*folder_ / "").c_str(), 1);     // NOLINT(concurrency-mt-unsafe)
        const bool is_found = is_set("de_DE.UTF-8");
        unsetenv("LOCPATH");  // NOLINT(concurrency-mt-unsafe)
        return is_found;
    }

    std::optional<TemporaryFolder> folder_;
    std::locale of_cpp_;
    std::string of_c_;
};

}  // namespace mirtest
