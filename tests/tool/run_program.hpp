// SPDX-License-Identifier: MIT
#pragma once

#include "support/temporary_folder.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace mirtest {

/// All bytes of a file; empty when there is none, or a device, which might never end.
inline std::string file_bytes(const std::filesystem::path& path) {
    if (!std::filesystem::is_regular_file(path)) return "";
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Waits until there is a file, for at most a minute.
inline void wait_for(const std::filesystem::path& path) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + std::chrono::minutes(1);
    while (!std::filesystem::exists(path) && Clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// How a program ended and what it said.
struct Outcome {
    int exit_code = -1;  ///< 128 + its number when a signal ended the program, as shells count
    std::string out;
    std::string err;
};

/// A program that runs beside the test, its output caught in files: pipes could fill up and stop
/// it. Killed with the object unless it was waited for.
class RunningProgram {
 public:
    /// Starts `command`, whose first word is the path of the program, in `folder`. Without standard
    /// input. `out` takes the place of the file that catches standard output.
    /// @throws std::system_error when it cannot be started.
    explicit RunningProgram(const std::vector<std::string>& command,
                            const std::filesystem::path& folder = ".",
                            const std::filesystem::path& out = {})
        : out_(out.empty() ? caught_ / "out" : out), err_(caught_ / "err") {
        std::vector<char*> arguments;
        for (const std::string& word : command)
            arguments.push_back(const_cast<char*>(word.c_str()));
        arguments.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        const int flags = O_WRONLY | O_CREAT;
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out_.c_str(), flags, 0600);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err_.c_str(), flags, 0600);
        posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
        const int failure =
            posix_spawn(&pid_, arguments[0], &actions, nullptr, arguments.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        if (failure != 0) throw std::system_error(failure, std::generic_category(), command[0]);
    }
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;
    ~RunningProgram() {
        if (ended_) return;
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }

    /// Sends the program a signal.
    void send(int signal) const { kill(pid_, signal); }

    /// Waits for the end. To be called once.
    Outcome wait() {
        int status = 0;
        while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) continue;
        ended_ = true;
        const int code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
        return {code, file_bytes(out_), file_bytes(err_)};
    }

 private:
    TemporaryFolder caught_{"run"};
    std::filesystem::path out_;
    std::filesystem::path err_;
    pid_t pid_ = 0;
    bool ended_ = false;
};

}  // namespace mirtest
