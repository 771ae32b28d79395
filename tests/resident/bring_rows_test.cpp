// SPDX-License-Identifier: MIT
#include "mir/resident/bring_rows.hpp"

#include "mir/host/backend.hpp"
#include "support/catch.hpp"
#include "support/lazy_backend.hpp"

#include <numeric>
#include <vector>

namespace {

/// Rows of numbers that count on come home, each once.
template <class Backend>
void check_rows(const Backend& backend, std::size_t rows, std::size_t width, std::size_t part) {
    mir::InlineExecutor executor;
    auto queue = backend.queue();
    std::vector<std::uint32_t> numbers(rows * width);
    std::iota(numbers.begin(), numbers.end(), 7u);
    auto there = backend.template buffer<std::uint32_t>(numbers.size());
    queue.upload(std::span<const std::uint32_t>(numbers), there);
    std::vector<std::uint32_t> home(numbers.size());
    std::vector<int> visits(rows);
    const std::uint32_t* const from = there.data();
    mir::bring_rows(
        backend, queue, executor, from, rows, width,
        [&](std::size_t i, std::span<const std::uint32_t> row) {
            REQUIRE(row.size() == width);
            std::copy(row.begin(), row.end(), home.begin() + i * width);
            ++visits[i];
        },
        part);
    CHECK(home == numbers);
    CHECK(visits == std::vector<int>(rows, 1));
}

}  // namespace

TEST_CASE("Rows come home in parts, each row once and in its place") {
    mir::InlineExecutor executor;
    for (const std::size_t rows : {1u, 2u, 3u, 8u, 9u}) {
        for (const std::size_t part : {1u, 40u, 80u, 100u, 1u << 20}) {
            CAPTURE(rows, part);
            check_rows(mir::host::Backend<mir::InlineExecutor>(executor), rows, 10, part);
            mirtest::PutOff work(0);
            check_rows(mirtest::LazyBackend(work), rows, 10, part);
        }
    }
    check_rows(mir::host::Backend<mir::InlineExecutor>(executor), 0, 10, 80);
}
