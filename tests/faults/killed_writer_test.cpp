// SPDX-License-Identifier: MIT
#include "faults/writers.hpp"
#include "support/catch.hpp"
#include "support/temporary_folder.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <random>
#include <utility>

namespace {

/// A child that writes one kind of file, both contents in turn, until it is killed.
class EndlessWriter {
 public:
    EndlessWriter(const std::array<mirtest::Writer, 2>& contents, const std::filesystem::path& path)
        : pid_(fork()) {
        if (pid_ != 0) return;
        try {
            for (std::size_t i = 0;; ++i) contents[i % 2].write(path);
        } catch (...) {
            _exit(3);
        }
    }
    EndlessWriter(const EndlessWriter&) = delete;
    EndlessWriter& operator=(const EndlessWriter&) = delete;
    ~EndlessWriter() {
        if (pid_ > 0) static_cast<void>(end());
    }

    /// Kills it; true when it wrote until then.
    [[nodiscard]] bool end() {
        kill(pid_, SIGKILL);
        int status = 0;
        waitpid(std::exchange(pid_, -1), &status, 0);
        return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
    }

 private:
    pid_t pid_;
};

}  // namespace

TEST_CASE("a writer that is killed at any moment leaves one whole file or the other") {
    const std::vector<mirtest::Writer> one = mirtest::all_writers(0);
    const std::vector<mirtest::Writer> two = mirtest::all_writers(1);
    std::mt19937 random(7);
    std::size_t left_over = 0;
    for (std::size_t kind = 0; kind < one.size(); ++kind) {
        const mirtest::TemporaryFolder folder("faults_killed");
        const std::filesystem::path path = folder / one[kind].name;
        INFO(one[kind].name);
        one[kind].write(path);
        const std::string first = mirtest::bytes_of_file(path);
        two[kind].write(path);
        const std::string second = mirtest::bytes_of_file(path);
        CHECK(first != second);
        std::array<std::size_t, 2> met{};
        for (int moment = 0; moment < 50; ++moment) {
            EndlessWriter writer({one[kind], two[kind]}, path);
            usleep(static_cast<useconds_t>(1000 + random() % 4000));
            CHECK(writer.end());
            const std::string bytes = mirtest::bytes_of_file(path);
            met[0] += bytes == first ? 1 : 0;
            met[1] += bytes == second ? 1 : 0;
            left_over += folder.files() - 1;
            REQUIRE(folder.files() <= 2);
        }
        CHECK(met[0] + met[1] == 50);
        // The next writer removes what the last one left.
        one[kind].write(path);
        CHECK(folder.files() == 1);
    }
    // Some writers were at work when they were killed.
    CHECK(left_over > 0);
}
