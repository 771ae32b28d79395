// SPDX-License-Identifier: MIT
#include "io/detail/jpeg_tables.hpp"

#include "io/gltf_fixture.hpp"
#include "support/catch.hpp"

#include <string>

using namespace mirtest;

namespace {

/// A mark with its segment.
std::string segment(char marker, const std::string& data) {
    const std::size_t length = data.size() + 2;
    return std::string("\xff") + marker + static_cast<char>(length >> 8) +
           static_cast<char>(length & 255) + data;
}

/// A table whose sixteen lengths have so many codes each.
std::string table(char each) {
    return std::string(1, '\0') + std::string(16, each) +
           std::string(16 * static_cast<std::size_t>(static_cast<unsigned char>(each)), 'x');
}

std::string check(const std::string& behind_start) {
    const std::string bytes = "\xff\xd8" + behind_start;
    return message_of([&] {
        mir::detail::check_jpeg_tables(
            {reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}, "image 0");
    });
}

}  // namespace

TEST_CASE("a Huffman table of a JPEG image has 256 codes at most") {
    const std::string good = segment('\xc4', table(16) + table(2));
    const std::string bad = segment('\xc4', table(2) + table(17));
    const std::string scan = segment('\xda', "123456") + std::string("ab\xff\0\xff\xd0", 6);
    CHECK(check(good) == "no error");
    CHECK(check(bad).find("image 0: it is no image (a Huffman table of 272 codes") == 0);
    CHECK(check(good + bad) != "no error");
    CHECK(check(good + scan) == "no error");
    CHECK(check(good + scan + bad) != "no error");
    CHECK(check(std::string(3, '\xff') + bad.substr(1)) != "no error");
    // What other segments hold is their own.
    CHECK(check(segment('\xe1', bad) + good + scan) == "no error");
    for (std::size_t size = 0; size < bad.size(); ++size) (void)check(bad.substr(0, size));
}
