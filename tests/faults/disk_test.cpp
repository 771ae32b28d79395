// SPDX-License-Identifier: MIT
#include "faults/writers.hpp"
#include "mir/core/error.hpp"
#include "support/catch.hpp"
#include "support/temporary_folder.hpp"

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace fs = std::filesystem;

namespace {

/// While it exists no file of this process can grow beyond `bytes`: writing fails, as on a disk
/// that is full.
class LargestFile {
 public:
    explicit LargestFile(std::uint64_t bytes) : old_signal_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &old_limit_);
        const rlimit limit{bytes, old_limit_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    LargestFile(const LargestFile&) = delete;
    LargestFile& operator=(const LargestFile&) = delete;
    ~LargestFile() {
        setrlimit(RLIMIT_FSIZE, &old_limit_);
        std::signal(SIGXFSZ, old_signal_);
    }

 private:
    rlimit old_limit_{};
    void (*old_signal_)(int);
};

/// Whether writing throws Error(io) that names the file.
bool is_refused(const mirtest::Writer& writer, const fs::path& path) {
    try {
        writer.write(path);
        return false;
    } catch (const mir::Error& error) {
        return error.code() == mir::ErrorCode::io &&
               std::string(error.what()).find(path.string()) != std::string::npos;
    }
}

}  // namespace

TEST_CASE("where a disk is full nothing but the older file is left, and an error says so") {
    const mirtest::TemporaryFolder folder("faults_disk");
    for (const mirtest::Writer& writer : mirtest::all_writers(0)) {
        const fs::path path = folder / writer.name;
        writer.write(path);
        const std::string whole = mirtest::bytes_of_file(path);
        mirtest::write_older_file(path);
        for (const std::uint64_t room :
             {std::size_t{0}, std::size_t{1}, whole.size() / 2, whole.size() - 1}) {
            INFO(writer.name << ", room for " << room << " of " << whole.size() << " bytes");
            bool refused = false;
            {
                const LargestFile full(room);
                refused = is_refused(writer, path);
            }
            CHECK(refused);
            CHECK(mirtest::bytes_of_file(path) == "older file");
            CHECK(folder.files() == 1);
        }
        {
            const LargestFile just_enough(whole.size());
            writer.write(path);
        }
        CHECK(mirtest::bytes_of_file(path) == whole);
        fs::remove(path);
    }
}

TEST_CASE("a folder that is a file, is missing or is not ours is an error that names the file") {
    const mirtest::TemporaryFolder folder("faults_folder");
    mirtest::write_older_file(folder / "file");
    for (const mirtest::Writer& writer : mirtest::all_writers(0)) {
        CHECK(is_refused(writer, folder / "file" / writer.name));
        CHECK(is_refused(writer, folder / "missing" / writer.name));
    }
    CHECK(folder.files() == 1);
}

TEST_CASE("a folder that may only be read is an error that names the file") {
    const mirtest::TemporaryFolder folder("faults_read_only");
    const std::vector<mirtest::Writer> writers = mirtest::all_writers(0);
    chmod((folder / "").c_str(), 0555);
    // Permissions do not bind root, so a child becomes nobody.
    const pid_t child = fork();
    if (child == 0) {
        const uid_t nobody = 65534;
        if (geteuid() == 0 && setuid(nobody) != 0) _exit(2);
        bool good = true;
        for (const mirtest::Writer& writer : writers)
            good = good && is_refused(writer, folder / writer.name);
        _exit(good ? 0 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    chmod((folder / "").c_str(), 0755);
    REQUIRE(WIFEXITED(status));
    if (WEXITSTATUS(status) == 2) {
        WARN("skipped: this process is root and may not become another user");
        return;
    }
    CHECK(WEXITSTATUS(status) == 0);
    CHECK(folder.files() == 0);
}
