// SPDX-License-Identifier: MIT
#include "mir/io/atomic_file.hpp"

#include "support/catch.hpp"
#include "support/temporary_folder.hpp"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <iterator>

namespace fs = std::filesystem;

namespace {

void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

std::string read(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_CASE("a committed file has its name and its content and leaves nothing else") {
    const mirtest::TemporaryFolder folder("atomic_file");
    {
        mir::AtomicFile file(folder / "picture.exr");
        CHECK(file.temporary().parent_path() == (folder / "picture.exr").parent_path());
        CHECK_FALSE(fs::exists(folder / "picture.exr"));
        write(file.temporary(), "new");
        file.commit();
        file.commit();
    }
    CHECK(read(folder / "picture.exr") == "new");
    CHECK(folder.files() == 1);
}

TEST_CASE("a file that is not committed leaves the older one as it was") {
    const mirtest::TemporaryFolder folder("atomic_file");
    write(folder / "picture.exr", "old");
    {
        mir::AtomicFile file(folder / "picture.exr");
        write(file.temporary(), "half of the n");
    }
    CHECK(read(folder / "picture.exr") == "old");
    CHECK(folder.files() == 1);
}

TEST_CASE("a file keeps the permissions of the one that it replaces, and nobody reads it before") {
    const mirtest::TemporaryFolder folder("atomic_file");
    const fs::path path = folder / "picture.exr";
    const auto permissions = [](const fs::path& of) { return fs::status(of).permissions(); };
    const auto replace = [&] {
        mir::AtomicFile file(path);
        const fs::perms before = permissions(file.temporary());
        write(file.temporary(), "new");
        file.commit();
        return before;
    };
    const mode_t mask = umask(022);
    CHECK(replace() == fs::perms(0644));
    CHECK(permissions(path) == fs::perms(0644));
    for (const int mode : {0600, 0640, 0666, 0400, 0755}) {
        INFO(mode);
        fs::permissions(path, fs::perms(mode));
        CHECK(replace() == fs::perms(0600));
        CHECK(permissions(path) == fs::perms(mode));
    }
    fs::permissions(path, fs::perms(0600));
    fs::create_symlink("picture.exr", folder / "link");
    mir::AtomicFile linked(folder / "link");
    linked.commit();
    CHECK(permissions(path) == fs::perms(0600));
    umask(mask);
}

TEST_CASE("names that lead nowhere are refused with the reason") {
    const mirtest::TemporaryFolder folder("atomic_file");
    fs::create_symlink("loop", folder / "loop");
    write(folder / "file", "");
    const auto refused = [](const fs::path& path, const std::string& why) {
        INFO(path);
        try {
            const mir::AtomicFile file(path);
            FAIL("no error");
        } catch (const mir::Error& e) {
            INFO(e.what());
            CHECK(e.code() == mir::ErrorCode::io);
            CHECK(std::string(e.what()).find("it cannot be written (" + why) != std::string::npos);
        }
    };
    refused(folder / "loop", "Too many levels of symbolic links");
    refused(folder / "loop/a.exr", "Too many levels of symbolic links");
    refused(folder / "file/a.exr", "Not a directory");
    refused(folder / (std::string(300, 'a') + ".exr"), "File name too long");
    refused(folder / (std::string(252, 'a')), "File name too long");
    CHECK(folder.files() == 2);
}

TEST_CASE("two writers of one file do not share a temporary name") {
    const mirtest::TemporaryFolder folder("atomic_file");
    mir::AtomicFile first(folder / "a");
    mir::AtomicFile second(folder / "a");
    CHECK(first.temporary() != second.temporary());
}

TEST_CASE("what a killed process left over is removed by the next writer of that name") {
    const mirtest::TemporaryFolder folder("atomic_file");
    for (const char* left : {".a.0.tmp", ".a.1.tmp", ".a.2.tmp", ".b.0.tmp"})
        write(folder / left, "half of it");
    {
        mir::AtomicFile file(folder / "a");
        write(file.temporary(), "new");
        file.commit();
    }
    CHECK(read(folder / "a") == "new");
    CHECK(read(folder / ".b.0.tmp") == "half of it");
    CHECK(folder.files() == 2);
}

TEST_CASE("a left-over behind names that are free is removed too") {
    const mirtest::TemporaryFolder folder("atomic_file");
    write(folder / ".a.1.tmp", "half of it");
    write(folder / ".a.5.tmp", "half of it");
    { const mir::AtomicFile file(folder / "a"); }
    CHECK(folder.files() == 0);
}

TEST_CASE("processes that begin to write one file at the same time get a name each") {
    const mirtest::TemporaryFolder folder("atomic_file");
    const auto begin_often = [&] {
        try {
            for (int i = 0; i < 5000; ++i) const mir::AtomicFile file(folder / "a");
            return true;
        } catch (...) {
            return false;
        }
    };
    const pid_t other = fork();
    if (other == 0) _exit(begin_often() ? 0 : 40);
    const bool mine = begin_often();
    int status = 0;
    waitpid(other, &status, 0);
    CHECK(mine);
    CHECK((WIFEXITED(status) && WEXITSTATUS(status) == 0));
    CHECK(folder.files() == 0);
}

TEST_CASE("what another process is writing is left to it, what it wrote before it was killed not") {
    const mirtest::TemporaryFolder folder("atomic_file");
    std::array<int, 2> ready{};
    REQUIRE(pipe(ready.data()) == 0);
    const pid_t writer = fork();
    if (writer == 0) {
        mir::AtomicFile file(folder / "a");
        write(file.temporary(), "half of it");
        static_cast<void>(::write(ready[1], "x", 1));
        while (true) pause();
    }
    char x = 0;
    REQUIRE(::read(ready[0], &x, 1) == 1);
    CHECK(mir::AtomicFile(folder / "a").temporary().filename() == ".a.1.tmp");
    CHECK(read(folder / ".a.0.tmp") == "half of it");
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    CHECK(folder.files() == 1);
    CHECK(mir::AtomicFile(folder / "a").temporary().filename() == ".a.0.tmp");
    CHECK(folder.files() == 0);
}

TEST_CASE("a link is followed, so that it still is a link afterwards") {
    const mirtest::TemporaryFolder folder("atomic_file");
    write(folder / "real", "old");
    fs::create_symlink(folder / "real", folder / "link");
    mir::AtomicFile file(folder / "link");
    write(file.temporary(), "new");
    file.commit();
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(read(folder / "real") == "new");
}

TEST_CASE("a target that cannot be written is refused by name and with a remedy") {
    const mirtest::TemporaryFolder folder("atomic_file");
    fs::create_directories(folder / "is_a_folder");
    const auto target = GENERATE("missing/a.exr", "is_a_folder", "is_a_folder/");
    try {
        mir::AtomicFile file(folder / target);
        FAIL("no error for " << target);
    } catch (const mir::Error& error) {
        CHECK(error.code() == mir::ErrorCode::io);
        CHECK(std::string(error.what()).find(target) != std::string::npos);
        CHECK(std::string(error.what()).find("; ") != std::string::npos);
    }
    CHECK(folder.files() == 1);
}

TEST_CASE("a device is not replaced by a file") {
    if (!fs::exists("/dev/null")) return;
    CHECK_THROWS_AS(mir::AtomicFile("/dev/null"), mir::Error);
}
