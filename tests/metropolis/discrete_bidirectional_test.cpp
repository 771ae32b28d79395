// SPDX-License-Identifier: MIT
// Veach's bidirectional mutation on a scene of three points, where every path, every way of
// deleting and inserting vertices and hence the whole transition matrix can be written down.
#include "metropolis/exact_chain.hpp"
#include "mir/metropolis/acceptance.hpp"
#include "support/catch.hpp"

#include <cstdlib>
#include <map>
#include <vector>

using mirtest::imbalance;

namespace {

constexpr std::size_t points = 3;
constexpr double balanced = 1e-12;
constexpr double broken = 1e-4;

/// Points from the lens to the light; the number of edges is one less.
using Path = std::vector<std::size_t>;

/// What a path contributes, and the probabilities of sampling vertices. A point cannot see itself,
/// and point 0 emits nothing.
struct Scene {
    double importance[points] = {1.0, 0.4, 2.0};
    double emission[points] = {0.0, 3.0, 1.0};
    double geometry[points][points] = {{0, 1.5, 0.3}, {1.5, 0, 0.8}, {0.3, 0.8, 0}};
    double lens[points] = {0.5, 0.2, 0.3};
    double light[points] = {0.1, 0.6, 0.3};
    double next[points][points] = {{0.1, 0.7, 0.2}, {0.5, 0.1, 0.4}, {0.25, 0.7, 0.05}};

    /// Reciprocal: the same from a to c as from c to a.
    [[nodiscard]] static double bsdf(std::size_t a, std::size_t b, std::size_t c) {
        return 0.2 + (a == c ? 1.0 : 0.1 * static_cast<double>(b + 1));
    }
    [[nodiscard]] double contribution(const Path& x) const {
        double f = importance[x.front()] * emission[x.back()];
        for (std::size_t i = 1; i < x.size(); ++i) f *= geometry[x[i - 1]][x[i]];
        for (std::size_t i = 2; i < x.size(); ++i) f *= bsdf(x[i - 2], x[i - 1], x[i]);
        return f;
    }
    /// Probability of continuing a walk from `b`, reached from `a`, to `c`: not symmetric, and
    /// sometimes to where no light can go.
    [[nodiscard]] double scatter(std::size_t a, std::size_t b, std::size_t c) const {
        return 0.5 * next[b][c] + (c == a ? 0.5 : 0.0);
    }
};

/// Vertices first .. last - 1 of a path of `size` vertices, which a mutation deletes or inserts.
struct Range {
    std::size_t first, last, size;
    [[nodiscard]] std::size_t count() const { return last - first; }
    /// The range after its vertices were exchanged for `inserted` others.
    [[nodiscard]] Range exchanged_for(std::size_t inserted) const {
        return {first, first + inserted, size - count() + inserted};
    }
};

enum class Fault {
    none,
    one_strategy,             // only the strategy that was used, instead of the sum of all
    deletion_of_source,       // the way back deletes with the source path's probability
    insertion_of_source,      // the way back inserts with the source path's probability
    forgotten_probabilities,  // neither deletion nor insertion enters K
    no_proposal_densities     // the ratio of contributions alone
};

template <Fault fault>
class BidirectionalMutation {
 public:
    /// Paths of 2 to `max_vertices` points.
    explicit BidirectionalMutation(std::size_t max_vertices) : max_vertices_(max_vertices) {
        for (std::size_t size = 2; size <= max_vertices; ++size)
            mirtest::for_each_tuple(points, size, [&](const Path& x) {
                if (scene_.contribution(x) <= 0.0) return;
                states_.emplace(x, target_.size());
                target_.push_back(scene_.contribution(x));
            });
    }

    [[nodiscard]] const std::vector<double>& target() const { return target_; }

    [[nodiscard]] mirtest::TransitionMatrix transitions() const {
        auto p = mirtest::no_transitions(target_.size());
        for (const auto& [x, i] : states_)
            for_each_range(x.size(), [&, &from = x, &row = p[i]](const Range& deleted) {
                for (std::size_t count = 0; count <= max_vertices_; ++count)
                    if (insertion_weight(deleted, count) > 0.0) exchange(from, deleted, count, row);
            });
        return mirtest::completed(p);
    }

 private:
    /// Calls f for every range that may be deleted, the empty ones between vertices included.
    template <class F>
    void for_each_range(std::size_t size, const F& f) const {
        for (std::size_t first = 0; first <= size; ++first)
            for (std::size_t last = first; last <= size; ++last) f(Range{first, last, size});
    }

    /// pmf_delete: short ranges are likelier; depends on the length of the path.
    [[nodiscard]] double pmf_delete(const Range& r) const {
        double sum = 0.0;
        for_each_range(r.size, [&](const Range& other) {
            sum += std::exp2(-static_cast<double>(other.count()));
        });
        return std::exp2(-static_cast<double>(r.count())) / sum;
    }

    /// Two-tailed geometric around the number deleted, 0 where the new path would have no edge or
    /// too many.
    [[nodiscard]] double insertion_weight(const Range& deleted, std::size_t count) const {
        const std::size_t size = deleted.exchanged_for(count).size;
        if (size < 2 || size > max_vertices_) return 0.0;
        return std::exp2(
            -std::fabs(static_cast<double>(count) - static_cast<double>(deleted.count())));
    }

    [[nodiscard]] double pmf_add(const Range& deleted, std::size_t count) const {
        double sum = 0.0;
        for (std::size_t other = 0; other <= max_vertices_; ++other)
            sum += insertion_weight(deleted, other);
        return insertion_weight(deleted, count) / sum;
    }

    /// p_{s,t}: the first s vertices of the range grown from the lens side, the others from the
    /// light side. A walk that has no vertex to start from starts on lens or light.
    [[nodiscard]] double pmf_vertices(const Path& y, const Range& inserted, std::size_t s) const {
        double p = 1.0;
        for (std::size_t i = inserted.first; i < inserted.first + s; ++i)
            p *= i == 0   ? scene_.lens[y[0]]
                 : i == 1 ? scene_.next[y[0]][y[1]]
                          : scene_.scatter(y[i - 2], y[i - 1], y[i]);
        for (std::size_t i = inserted.last; i-- > inserted.first + s;) {
            const std::size_t behind = y.size() - 1 - i;  // vertices between this one and the end
            p *= behind == 0   ? scene_.light[y[i]]
                 : behind == 1 ? scene_.next[y[i + 1]][y[i]]
                               : scene_.scatter(y[i + 2], y[i + 1], y[i]);
        }
        return p;
    }

    /// Probability of using s vertices from the lens side, all numbers alike.
    [[nodiscard]] static double pmf_strategy(const Range& inserted) {
        return 1.0 / static_cast<double>(inserted.count() + 1);
    }

    /// K(y|x): `deleted` in x is exchanged for `inserted` in y, by any strategy.
    [[nodiscard]] double density(const Range& deleted, const Path& y, const Range& inserted,
                                 std::size_t used) const {
        double sum = 0.0;
        for (std::size_t s = 0; s <= inserted.count(); ++s)
            if (fault != Fault::one_strategy || s == std::min(used, inserted.count()))
                sum += pmf_strategy(inserted) * pmf_vertices(y, inserted, s);
        if (fault == Fault::forgotten_probabilities) return sum;
        return pmf_delete(deleted) * pmf_add(deleted, inserted.count()) * sum;
    }

    [[nodiscard]] double accepted(const Path& x, const Range& deleted, const Path& y,
                                  const Range& inserted, std::size_t used) const {
        const double f_x = scene_.contribution(x);
        const double f_y = scene_.contribution(y);
        if (fault == Fault::no_proposal_densities) return mir::acceptance(f_x, f_y);
        double back = density(inserted, x, deleted, used);
        if (fault == Fault::deletion_of_source) back *= pmf_delete(deleted) / pmf_delete(inserted);
        if (fault == Fault::insertion_of_source)
            back *= pmf_add(deleted, inserted.count()) / pmf_add(inserted, deleted.count());
        return mir::acceptance(f_x, density(deleted, y, inserted, used), f_y, back);
    }

    /// Adds to `row` every outcome of exchanging `deleted` in x for `count` vertices.
    void exchange(const Path& x, const Range& deleted, std::size_t count,
                  std::vector<double>& row) const {
        const Range inserted = deleted.exchanged_for(count);
        mirtest::for_each_tuple(points, count, [&](const Path& fresh) {
            Path y(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(deleted.first));
            y.insert(y.end(), fresh.begin(), fresh.end());
            y.insert(y.end(), x.begin() + static_cast<std::ptrdiff_t>(deleted.last), x.end());
            const auto state = states_.find(y);
            if (state == states_.end()) return;
            for (std::size_t s = 0; s <= count; ++s) {
                const double p = pmf_delete(deleted) * pmf_add(deleted, count) *
                                 pmf_strategy(inserted) * pmf_vertices(y, inserted, s);
                if (p > 0.0) row[state->second] += p * accepted(x, deleted, y, inserted, s);
            }
        });
    }

    Scene scene_;
    std::size_t max_vertices_;
    std::map<Path, std::size_t> states_;
    std::vector<double> target_;
};

template <Fault fault>
double imbalance_with(std::size_t max_vertices) {
    const BidirectionalMutation<fault> mutation(max_vertices);
    return imbalance(mutation.target(), mutation.transitions());
}

}  // namespace

TEST_CASE("the bidirectional mutation is in detailed balance on a scene of three points") {
    for (std::size_t max_vertices : {2u, 3u, 4u}) {
        CAPTURE(max_vertices);
        CHECK(imbalance_with<Fault::none>(max_vertices) < balanced);
    }
    CHECK(BidirectionalMutation<Fault::none>(3).target().size() == 12);
}

TEST_CASE("the bidirectional mutation reaches every path from every other") {
    const BidirectionalMutation<Fault::none> mutation(4);
    for (const auto& row : mutation.transitions())
        for (double p : row) CHECK(p > 0.0);
}

// Up to four vertices: with fewer there are two lengths to choose from, either way alike.
TEST_CASE("wrong densities of the bidirectional mutation are rejected") {
    CHECK(imbalance_with<Fault::one_strategy>(4) > broken);
    CHECK(imbalance_with<Fault::deletion_of_source>(4) > broken);
    CHECK(imbalance_with<Fault::insertion_of_source>(4) > broken);
    CHECK(imbalance_with<Fault::forgotten_probabilities>(4) > broken);
    CHECK(imbalance_with<Fault::no_proposal_densities>(4) > broken);
}
