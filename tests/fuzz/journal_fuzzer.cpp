// SPDX-License-Identifier: MIT
#include "fuzz/input_file.hpp"
#include "mir/io/pass_journal.hpp"

#include <sstream>

namespace {

const mir::Scene scene;

mir::RenderSettings settings() {
    mir::RenderSettings s;
    s.image = {3, 2};
    return s;
}

std::string written(const mir::PassSums& sums) {
    std::ostringstream stream;
    mir::detail::JournalWriter writer(stream);
    writer(sums);
    return stream.str();
}

/// What stands in a journal of `settings()` before the sums.
std::string start_of_journal(const std::filesystem::path& path) {
    mir::PassJournal(path, scene, settings()).write({});
    std::ifstream stream(path, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(stream), {}};
    return whole.substr(0, whole.size() - written({}).size() - sizeof(std::uint64_t));
}

/// The hash that makes a file of these bytes one that was not damaged.
std::string hash_behind(std::string_view start, std::string_view sums) {
    constexpr std::size_t magic = sizeof("mir passes 1\n") - 1;
    mir::ByteHash hash;
    hash.add(start.data() + magic, start.size() - magic);
    hash.add(sums.data(), sums.size());
    const std::uint64_t value = hash.value();
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

}  // namespace

/// An even first byte: what follows is the file. An odd one: it is the sums of a journal that
/// belongs to the render and whose hash is right, so that the reader gets to see all of them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    static const std::filesystem::path path = mirfuzz::input_file("a.journal", "");
    static const std::string start = start_of_journal(path);
    static const mir::PassJournal journal(path, scene, settings());
    const std::string_view rest = mirfuzz::text_of(data + 1, size - 1);
    if (data[0] % 2 == 0)
        mirfuzz::input_file("a.journal", rest);
    else
        mirfuzz::input_file("a.journal", start + std::string(rest) + hash_behind(start, rest));
    try {
        const std::string sums = written(journal.read());
        mirfuzz::require(data[0] % 2 == 0 || sums == rest);
    } catch (const mir::Error& refused) {
        mirfuzz::require(refused.code() == mir::ErrorCode::invalid_argument);
    }
    return 0;
}
