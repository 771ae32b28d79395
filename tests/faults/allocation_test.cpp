// SPDX-License-Identifier: MIT
#include "faults/failing_new.hpp"
#include "faults/writers.hpp"
#include "mir/io/exr.hpp"
#include "mir/io/gltf_reader.hpp"
#include "mir/io/scene_reader.hpp"
#include "mir/scene/scene_hash.hpp"
#include "support/catch.hpp"
#include "support/temporary_folder.hpp"

#include <OpenEXR/ImfHeader.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <optional>
#include <utility>

// With the address sanitizer these are tests for leaks as well.

namespace fs = std::filesystem;
using mirtest::AllocationFault;
using mirtest::fail_allocations;
using mirtest::LargestAllocation;

namespace {

const fs::path corpus = MIR_FUZZ_CORPUS_DIR;

/// How the children of fail_in_children() ended.
struct ChildEnds {
    std::uint64_t tried = 0;
    std::uint64_t unfair = 0;   ///< an exception that it should not be
    std::uint64_t aborted = 0;  ///< by an assertion
};

/// Exit codes of a child, far from those of a test program that goes on in it.
enum ChildCode : std::uint8_t { was_done = 40, failed, blamed_input, foreign };

/// How `work` ends whose n-th allocation fails, aborting where a library does.
template <class Work>
ChildCode fail_once(const Work& work, std::uint64_t n) {
    std::signal(SIGABRT, SIG_DFL);
    close(STDERR_FILENO);
    const AllocationFault fault(n);
    try {
        work();
    } catch (const std::bad_alloc&) {
        return failed;
    } catch (const mir::Error& error) {
        return mirtest::is_fair(error) ? failed : blamed_input;
    } catch (...) {
        return foreign;
    }
    return fault.struck() ? failed : was_done;
}

/// fail_allocations() for libraries that may abort: each failure in a process of its own, and
/// look() after each.
template <class Work, class Look>
ChildEnds fail_in_children(const Work& work, const Look& look) {
    ChildEnds ends;
    while (true) {
        const pid_t child = fork();
        if (child == 0) _exit(fail_once(work, ends.tried + 1));
        int status = 0;
        waitpid(child, &status, 0);
        look();
        if (WIFEXITED(status) && WEXITSTATUS(status) == was_done) return ends;
        ++ends.tried;
        if (WIFSIGNALED(status)) ++ends.aborted;
        if (WIFEXITED(status) && WEXITSTATUS(status) != failed) ++ends.unfair;
    }
}

/// A copy of a fuzzer's seed under a name that says its format.
void copy_seed(const fs::path& seed, const fs::path& to) {
    const std::string bytes = mirtest::bytes_of_file(corpus / seed);
    REQUIRE_FALSE(bytes.empty());
    std::ofstream(to, std::ios::binary) << bytes.substr(0, bytes.find("\n%\n"));
}

}  // namespace

TEST_CASE("the fault strikes the call that it is asked for, once") {
    int done = 0;
    const auto result = fail_allocations(
        10, 1,
        [] {
            const auto a = std::make_unique<int>(1);
            const auto b = std::make_unique<int>(2);
            REQUIRE(*a + *b == 3);
        },
        [&](bool was_done) { done += was_done ? 1 : 0; });
    CHECK(result.tried == 2);
    CHECK(result.survived == 0);
    CHECK(done == 1);
}

TEST_CASE("a reader whose allocations fail throws, or returns the scene all the same") {
    const mirtest::TemporaryFolder folder("faults_read");
    using Seed = std::pair<const char*, const char*>;
    const auto seed = GENERATE(Seed("obj/cube.txt", "a.obj"), Seed("ply/ascii.ply", "a.ply"));
    const fs::path file = folder / seed.second;
    copy_seed(seed.first, file);
    const std::string whole = mir::SceneHash(mir::read_scene(file).scene).hex();
    std::string hash;
    mir::LoadedScene read;
    std::size_t wrong = 0;
    const auto result = fail_allocations(
        100000, 1, [&] { read = mir::read_scene(file); },
        [&](bool done) {
            if (done && mir::SceneHash(read.scene).hex() != whole) ++wrong;
        });
    INFO(seed.second << ": " << result.tried << " allocations, survived " << result.survived);
    CHECK(result.tried > 50);
    CHECK(wrong == 0);
}

TEST_CASE("a reader of glTF whose allocations fail does not blame the file") {
    const fs::path seed = corpus / "gltf/everything.gltf";
    const ChildEnds ends =
        fail_in_children([&] { static_cast<void>(mir::read_gltf(seed)); }, [] {});
    INFO(ends.tried << " allocations, aborted by assertions of tinygltf's JSON " << ends.aborted);
    CHECK(ends.tried > 200);
    CHECK(ends.unfair == 0);
    CHECK(ends.aborted < ends.tried / 2);
}

TEST_CASE("a reader of OpenEXR whose allocations fail throws") {
    // OpenEXR does not survive a failure while it registers its types, once in a process.
    Imf::staticInitialize();
    [[maybe_unused]] const mirtest::LeaksOfOthers leaks{};
    const auto result = fail_allocations(
        100000, 1, [] { static_cast<void>(mir::read_exr(corpus / "exr/layers.exr")); },
        [](bool) {});
    CHECK(result.tried > 50);
}

TEST_CASE(
    "a writer whose allocations fail leaves the older file or a whole new one, and no other") {
    const mirtest::TemporaryFolder folder("faults_write");
    for (const mirtest::Writer& writer : mirtest::all_writers(0)) {
        if (writer.name == "a.glb") continue;  // below
        const fs::path path = folder / writer.name;
        writer.write(path);
        const std::string whole = mirtest::bytes_of_file(path);
        std::size_t wrong = 0;
        std::optional<mirtest::LeaksOfOthers> leaks;
        if (writer.name == "a.exr") leaks.emplace();
        mirtest::write_older_file(path);
        const auto result = fail_allocations(
            100000, 1, [&] { writer.write(path); },
            [&](bool done) {
                const std::string bytes = mirtest::bytes_of_file(path);
                if (bytes != (done ? whole : "older file") || folder.files() != 1) ++wrong;
                mirtest::write_older_file(path);
            });
        INFO(writer.name << ": " << result.tried << " allocations, survived " << result.survived);
        CHECK(result.tried > 3);
        CHECK(wrong == 0);
        fs::remove(path);
    }
}

TEST_CASE("a writer of glTF whose allocations fail leaves the older file or a whole new one") {
    const mirtest::TemporaryFolder folder("faults_glb");
    const fs::path path = folder / "a.glb";
    const auto writers = mirtest::all_writers(0);
    const auto writer = std::find_if(writers.begin(), writers.end(),
                                     [](const mirtest::Writer& w) { return w.name == "a.glb"; });
    writer->write(path);
    const std::string whole = mirtest::bytes_of_file(path);
    mirtest::write_older_file(path);
    std::size_t wrong = 0;
    const ChildEnds ends = fail_in_children([&] { writer->write(path); },
                                            [&] {
                                                const std::string bytes =
                                                    mirtest::bytes_of_file(path);
                                                if (bytes != whole && bytes != "older file")
                                                    ++wrong;
                                            });
    INFO(ends.tried << " allocations, aborted by assertions of tinygltf's JSON " << ends.aborted);
    CHECK(ends.tried > 200);
    CHECK(ends.unfair == 0);
    CHECK(ends.aborted < ends.tried / 2);
    CHECK(wrong == 0);
}

TEST_CASE("small files that announce much do not get much memory") {
    const mirtest::TemporaryFolder folder("faults_found");
    for (const auto& entry : fs::directory_iterator(fs::path(MIR_FOUND_INPUTS_DIR) / "exr")) {
        INFO(entry.path().filename());
        const LargestAllocation largest;
        CHECK_THROWS_AS(mir::read_exr(entry.path()), mir::Error);
        CHECK(largest.bytes() < 1u << 20);
    }
}
