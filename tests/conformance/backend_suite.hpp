// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/backend_kernels.hpp"
#include "mir/concepts/backend.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <vector>

// The axioms of Backend. Free of Catch2, so that a compiler of kernels can build it: what is found
// is returned, and the file that asked asserts that nothing is wrong.

namespace mirtest {

/// How many elements of an experiment came out wrong.
struct Finding {
    std::string experiment;
    std::size_t wrong = 0;
};

/// The experiments, each on new queues and buffers.
template <mir::Backend B>
class BackendExperiments {
 public:
    explicit BackendExperiments(const B& backend) : backend_(backend) {}

    /// Axiom 3, from and to pinned and plain memory. What lies behind a copy stays as it was.
    [[nodiscard]] std::size_t wrong_after_round_trip(std::uint32_t n) const {
        const std::uint32_t behind = 7;
        auto there = backend_.template buffer<std::uint32_t>(n + behind);
        auto pinned = backend_.template host_buffer<std::uint32_t>(n + behind);
        const Words all(n + behind, 5u);
        const Words front = numbers(n);
        Words home(n + behind);
        auto queue = backend_.queue();
        queue.upload(std::span<const std::uint32_t>(all), there);
        queue.upload(std::span<const std::uint32_t>(front), there);
        queue.download(there, pinned.span());
        queue.download(there, std::span<std::uint32_t>(home));
        queue.record().sync();
        Words wanted = front;
        wanted.resize(n + behind, 5u);
        return differences(home, wanted) + differences(copy_of(pinned), wanted);
    }

    /// Axiom 3, the second half: zeros everywhere.
    [[nodiscard]] std::size_t wrong_after_clear(std::uint32_t n) const {
        Words words = numbers(n);
        auto there = backend_.template buffer<std::uint32_t>(n);
        auto queue = backend_.queue();
        queue.upload(std::span<const std::uint32_t>(words), there);
        queue.clear(there);
        queue.download(there, std::span<std::uint32_t>(words));
        queue.record().sync();
        return differences(words, Words(n, 0u));
    }

    /// Axiom 4, for_each: two visits of each index below n, none behind.
    [[nodiscard]] std::size_t wrong_visits(std::uint32_t n) const {
        const std::uint32_t behind = 300;
        Words visits(n + behind, 0u);
        auto there = backend_.template buffer<std::uint32_t>(n + behind);
        auto queue = backend_.queue();
        queue.upload(std::span<const std::uint32_t>(visits), there);
        queue.for_each(n, CountVisit{there.data()});
        queue.for_each(n, CountVisit{there.data()});
        queue.download(there, std::span<std::uint32_t>(visits));
        queue.record().sync();
        Words wanted(n, 2u);
        wanted.resize(n + behind, 0u);
        return differences(visits, wanted);
    }

    /// Axiom 4, fill_bits: every word as stated, none behind.
    [[nodiscard]] std::size_t wrong_words(std::uint32_t rows, std::uint32_t columns) const {
        const std::size_t count = std::size_t{rows / 32} * columns;
        Words words(count + 64, 0xABCDu);
        auto there = backend_.template buffer<std::uint32_t>(words.size());
        auto queue = backend_.queue();
        queue.upload(std::span<const std::uint32_t>(words), there);
        queue.fill_bits(rows, columns, ScrambledBits{}, there.data());
        queue.download(there, std::span<std::uint32_t>(words));
        queue.record().sync();
        return differences(words, expected_words(rows, columns, words.size()));
    }

    /// Axiom 4, for_each_group: one visit of each index below n with the right result, none behind.
    [[nodiscard]] std::size_t wrong_groups(std::uint32_t n) const {
        const std::uint32_t behind = 9;
        Words words(n + behind, 7u);
        Words lanes(1, 0u);
        auto there = backend_.template buffer<std::uint32_t>(words.size());
        auto counter = backend_.template buffer<std::uint32_t>(1);
        auto queue = backend_.queue();
        queue.upload(std::span<const std::uint32_t>(words), there);
        queue.clear(counter);
        queue.for_each_group(n, GroupVisit{there.data(), counter.data()});
        queue.download(there, std::span<std::uint32_t>(words));
        queue.download(counter, std::span<std::uint32_t>(lanes));
        queue.record().sync();
        Words wanted(n + behind, 7u);
        for (std::uint32_t i = 0; i < n; ++i) wanted[i] += GroupVisit::expected(i);
        return differences(words, wanted) + differences(lanes, Words(1, 32 * n));
    }

    /// What groups make of floats.
    [[nodiscard]] std::size_t wrong_extremes(std::uint32_t n) const {
        Words words(n, 0u);
        auto there = backend_.template buffer<std::uint32_t>(n);
        auto queue = backend_.queue();
        queue.for_each_group(n, GroupExtremes{there.data()});
        queue.download(there, std::span<std::uint32_t>(words));
        queue.record().sync();
        std::size_t wrong = 0;
        for (std::uint32_t i = 0; i < n; ++i) wrong += words[i] != GroupExtremes::expected(i);
        return wrong;
    }

    /// Strict functions that differ in a bit from what the host's operators are rounded to.
    [[nodiscard]] std::size_t wrong_values(StrictFunction function) const {
        Words words(StrictValues::count, 0u);
        auto there = backend_.template buffer<std::uint32_t>(words.size());
        auto queue = backend_.queue();
        queue.for_each(StrictValues::count, StrictValues{function, there.data()});
        queue.download(there, std::span<std::uint32_t>(words));
        queue.record().sync();
        std::size_t wrong = 0;
        for (std::uint32_t i = 0; i < StrictValues::count; ++i)
            wrong += words[i] != StrictValues::expected(function, i);
        return wrong;
    }

    /// Axiom 6: pairs whose keys are the `distinct` first numbers, spread over 64 bits. What lies
    /// behind them stays as it was.
    [[nodiscard]] std::size_t wrong_after_sort(std::uint32_t n, std::uint32_t distinct) const {
        const std::uint32_t behind = 7;
        std::vector<std::uint64_t> keys(n + behind, 5u);
        Words values = numbers(n + behind);
        for (std::uint32_t i = 0; i < n; ++i)
            keys[i] = (scrambled(i) % distinct) * 0x0123456789ABCDEFull;
        auto keys_there = backend_.template buffer<std::uint64_t>(n + behind);
        auto values_there = backend_.template buffer<std::uint32_t>(n + behind);
        auto queue = backend_.queue();
        auto scratch = backend_.template buffer<std::byte>(queue.scratch_bytes(n));
        queue.upload(std::span<const std::uint64_t>(keys), keys_there);
        queue.upload(std::span<const std::uint32_t>(values), values_there);
        queue.sort_by_key(n, keys_there.data(), values_there.data(), scratch);
        std::vector<std::uint64_t> sorted_keys(n + behind);
        Words sorted_values(n + behind);
        queue.download(keys_there, std::span<std::uint64_t>(sorted_keys));
        queue.download(values_there, std::span<std::uint32_t>(sorted_values));
        queue.record().sync();
        const Words order = stable_order(keys, n);
        std::size_t wrong = 0;
        for (std::uint32_t i = 0; i < n + behind; ++i) {
            const std::uint32_t from = i < n ? order[i] : i;
            wrong += sorted_keys[i] != keys[from] || sorted_values[i] != values[from] ? 1 : 0;
        }
        return wrong;
    }

    /// Axiom 6: sums that wrap around, none behind, within a scratch for more elements.
    [[nodiscard]] std::size_t wrong_sums(std::uint32_t n) const {
        const std::uint32_t behind = 7;
        const Words words = numbers(n);
        Words sums(n + behind, 5u);
        auto from = backend_.template buffer<std::uint32_t>(n);
        auto to = backend_.template buffer<std::uint32_t>(n + behind);
        auto queue = backend_.queue();
        auto scratch = backend_.template buffer<std::byte>(queue.scratch_bytes(2 * n + 1));
        queue.upload(std::span<const std::uint32_t>(words), from);
        queue.upload(std::span<const std::uint32_t>(sums), to);
        queue.sum_before(n, from.data(), to.data(), scratch);
        queue.download(to, std::span<std::uint32_t>(sums));
        queue.record().sync();
        Words wanted(n + behind, 5u);
        std::uint32_t sum = 0;
        for (std::uint32_t i = 0; i < n; ++i) {
            wanted[i] = sum;
            sum += words[i];
        }
        return differences(sums, wanted);
    }

    /// Axiom 1: a chain of kernels and copies, each of which needs the one before.
    [[nodiscard]] std::size_t wrong_after_chain(std::uint32_t n, std::uint32_t length) const {
        std::array<typename B::template Buffer<std::uint32_t>, 2> there{
            backend_.template buffer<std::uint32_t>(n), backend_.template buffer<std::uint32_t>(n)};
        auto pinned = backend_.template host_buffer<std::uint32_t>(n);
        Words state = numbers(n);
        {
            auto queue = backend_.queue();
            queue.upload(std::span<const std::uint32_t>(state), there[0]);
            for (std::uint32_t k = 0; k < length; ++k) {
                queue.for_each(n, MoveAcross{there[0].data(), there[1].data(), n});
                queue.download(there[1], pinned.span());
                queue.upload(std::span<const std::uint32_t>(pinned.span()), there[0]);
            }
            queue.record().sync();
        }
        for (std::uint32_t k = 0; k < length; ++k) state = moved_across(state);
        return differences(copy_of(pinned), state);
    }

    /// Axiom 2: a second queue reads what a first one writes slowly, behind an event.
    [[nodiscard]] std::size_t wrong_after_wait(std::uint32_t n, std::uint32_t steps) const {
        auto slow = backend_.template buffer<std::uint32_t>(n);
        auto moved = backend_.template buffer<std::uint32_t>(n);
        auto pinned = backend_.template host_buffer<std::uint32_t>(n);
        auto writes = backend_.queue();
        auto reads = backend_.queue();
        writes.for_each(n, SlowScramble{slow.data(), 0});
        writes.record().sync();
        writes.for_each(n, SlowScramble{slow.data(), steps});
        reads.wait(writes.record());
        reads.for_each(n, MoveAcross{slow.data(), moved.data(), n});
        reads.download(moved, pinned.span());
        reads.record().sync();
        return differences(copy_of(pinned), moved_across(slowly_scrambled(n, steps)));
    }

    /// Axiom 2 for the caller: after sync() the host reads what came home.
    [[nodiscard]] std::size_t wrong_after_sync(std::uint32_t n, std::uint32_t steps) const {
        auto slow = backend_.template buffer<std::uint32_t>(n);
        auto pinned = backend_.template host_buffer<std::uint32_t>(n);
        std::fill(pinned.span().begin(), pinned.span().end(), 0u);
        auto queue = backend_.queue();
        queue.for_each(n, SlowScramble{slow.data(), steps});
        queue.download(slow, pinned.span());
        const auto done = queue.record();
        done.sync();
        return differences(copy_of(pinned), slowly_scrambled(n, steps));
    }

    /// Axiom 5: the end of a queue waits.
    [[nodiscard]] std::size_t wrong_after_end(std::uint32_t n, std::uint32_t steps) const {
        auto slow = backend_.template buffer<std::uint32_t>(n);
        auto pinned = backend_.template host_buffer<std::uint32_t>(n);
        std::fill(pinned.span().begin(), pinned.span().end(), 0u);
        {
            auto queue = backend_.queue();
            queue.for_each(n, SlowScramble{slow.data(), steps});
            queue.download(slow, pinned.span());
        }
        return differences(copy_of(pinned), slowly_scrambled(n, steps));
    }

 private:
    using Words = std::vector<std::uint32_t>;

    static std::size_t differences(const Words& a, const Words& b) {
        std::size_t count = a.size() == b.size() ? 0 : 1;
        for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) count += a[i] != b[i];
        return count;
    }
    static Words numbers(std::uint32_t n) {
        Words words(n);
        for (std::uint32_t i = 0; i < n; ++i) words[i] = scrambled(i + 1);
        return words;
    }
    static Words copy_of(typename B::template HostBuffer<std::uint32_t>& buffer) {
        return Words(buffer.span().begin(), buffer.span().end());
    }
    static Words moved_across(const Words& from) {
        Words to(from.size());
        const MoveAcross kernel{from.data(), to.data(), static_cast<std::uint32_t>(from.size())};
        for (std::uint32_t i = 0; i < kernel.n; ++i) kernel(i);
        return to;
    }
    /// Indices of the first `n` keys in the order of a stable sort.
    static Words stable_order(const std::vector<std::uint64_t>& keys, std::uint32_t n) {
        Words order(n);
        std::iota(order.begin(), order.end(), 0u);
        std::stable_sort(order.begin(), order.end(),
                         [&keys](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
        return order;
    }
    static Words slowly_scrambled(std::uint32_t n, std::uint32_t steps) {
        Words out(n);
        for (std::uint32_t i = 0; i < n; ++i) SlowScramble{out.data(), steps}(i);
        return out;
    }
    static Words expected_words(std::uint32_t rows, std::uint32_t columns, std::size_t size) {
        Words words(std::size_t{rows / 32} * columns, 0u);
        const ScrambledBits kernel;
        for (std::uint32_t i = 0; i < rows; ++i)
            for (std::uint32_t j = 0; j < columns; ++j)
                words[std::size_t{i / 32} * columns + j] |=
                    static_cast<std::uint32_t>(kernel(kernel.row(i), j)) << (i % 32);
        words.resize(size, 0xABCDu);
        return words;
    }

    B backend_;
};

/// Everything that the axioms say, tried on a backend.
template <mir::Backend B>
std::vector<Finding> examine_backend(const B& backend) {
    const BackendExperiments<B> experiments(backend);
    std::vector<Finding> findings;
    const auto named = [&](const std::string& what, std::uint32_t n, std::size_t wrong) {
        findings.push_back({what + ", size " + std::to_string(n), wrong});
    };
    for (std::uint32_t n : {0u, 1u, 31u, 1000u, 1u << 20}) {
        named("upload, then download", n, experiments.wrong_after_round_trip(n));
        named("clear, then download", n, experiments.wrong_after_clear(n));
        named("visits of for_each", n, experiments.wrong_visits(n));
        named("sums of those before", n, experiments.wrong_sums(n));
        for (std::uint32_t distinct : {1u, 100u, 1u << 31})
            named("sorting by " + std::to_string(distinct) + " keys", n,
                  experiments.wrong_after_sort(n, distinct));
    }
    for (std::uint32_t rows : {0u, 32u, 256u, 1056u})
        for (std::uint32_t columns : {0u, 1u, 31u, 32u, 33u, 100u})
            named("words of fill_bits in " + std::to_string(columns) + " columns", rows,
                  experiments.wrong_words(rows, columns));
    for (std::uint32_t n : {0u, 1u, 3u, 4u, 5u, 1000u})
        named("visits of for_each_group", n, experiments.wrong_groups(n));
    named("extremes of groups", 3000, experiments.wrong_extremes(3000));
    named("roots", StrictValues::count, experiments.wrong_values(StrictFunction::root));
    named("reciprocals", StrictValues::count, experiments.wrong_values(StrictFunction::reciprocal));
    named("the smaller of two", StrictValues::count,
          experiments.wrong_values(StrictFunction::at_most_two));
    named("order in one queue", 3000, experiments.wrong_after_chain(3000, 20));
    constexpr std::uint32_t slow = 1u << 14;
    named("queue behind an event", 300, experiments.wrong_after_wait(300, slow));
    named("caller behind an event", 300, experiments.wrong_after_sync(300, slow));
    named("caller behind the end of a queue", 300, experiments.wrong_after_end(300, slow));
    return findings;
}

}  // namespace mirtest
