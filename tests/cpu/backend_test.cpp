// SPDX-License-Identifier: MIT
#include "mir/host/backend.hpp"

#include "conformance/backend_suite.hpp"
#include "mir/data/soa.hpp"
#include "mir/host/tbb_executor.hpp"
#include "support/catch.hpp"
#include "support/lazy_backend.hpp"

namespace {

void check_all(const std::vector<mirtest::Finding>& findings) {
    CHECK(findings.size() > 30);
    for (const auto& [experiment, wrong] : findings) {
        INFO(experiment);
        CHECK(wrong == 0);
    }
}

}  // namespace

TEST_CASE("The host keeps the axioms of Backend, on one thread and on many") {
    mir::InlineExecutor one;
    mir::TbbExecutor many(3);
    check_all(mirtest::examine_backend(mir::host::Backend(one)));
    check_all(mirtest::examine_backend(mir::host::Backend(many)));
}

TEST_CASE("A host that does nothing before it has to keeps the axioms of Backend") {
    mirtest::PutOff work(GENERATE(0u, ~0u));
    check_all(mirtest::examine_backend(mirtest::LazyBackend(work)));
}
