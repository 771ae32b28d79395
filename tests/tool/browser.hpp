// SPDX-License-Identifier: MIT
#pragma once

#include "support/temporary_folder.hpp"
#include "tool/mir_program.hpp"

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

namespace mirtest {

/// A headless browser of Chromium's family on the path; empty when there is none.
inline std::string browser() {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
            if (std::filesystem::exists(folder + "/" + name)) return folder + "/" + name;
    return "";
}

/// Opens a page and returns what the browser says; `more` tells what to do with it.
inline Outcome open_page(const std::filesystem::path& page, const TemporaryFolder& folder,
                         const Words& more) {
    return RunningProgram(Words{browser(), "--headless", "--no-sandbox", "--disable-gpu",
                                "--disable-dev-shm-usage", "--enable-logging=stderr",
                                "--user-data-dir=" + (folder / "profile").string(),
                                "--window-size=800,900", "--virtual-time-budget=5000"} +
                          more + Words{"file://" + page.string()})
        .wait();
}

}  // namespace mirtest
