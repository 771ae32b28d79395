// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

/// Checks of the axioms that concepts cannot express, for your own types. They are functions that
/// run a model through its paces and return a Report. They print nothing, throw nothing of their
/// own and need no test framework. Numbers are drawn with fixed seeds: the same model gets the same
/// report each time.
namespace mir::validation {

/// An axiom that a model broke.
struct Finding {
    std::string axiom;  ///< what must hold
    std::string found;  ///< what was found instead, with numbers
};

/// What a check found. A value; not for use by several threads at once.
class Report {
 public:
    /// Counts a check of `axiom`; notes `found` when `holds` is false.
    void expect(bool holds, std::string axiom, std::string found) {
        ++checks_;
        if (!holds) findings_.push_back({std::move(axiom), std::move(found)});
    }

    /// Takes over the checks and findings of another report, its axioms named "`part`: axiom".
    void add(const std::string& part, const Report& other) {
        checks_ += other.checks_;
        for (const Finding& f : other.findings_)
            findings_.push_back({part + ": " + f.axiom, f.found});
    }

    /// True when something was checked and every axiom held.
    [[nodiscard]] bool passed() const { return checks_ > 0 && findings_.empty(); }
    /// Checks made, those that held included.
    [[nodiscard]] std::size_t checks() const { return checks_; }
    /// What broke, in the order of the checks.
    [[nodiscard]] const std::vector<Finding>& findings() const { return findings_; }

    /// A line per finding, "axiom: found"; empty when there is none.
    [[nodiscard]] std::string text() const {
        std::string lines;
        for (const Finding& f : findings_) lines += f.axiom + ": " + f.found + '\n';
        return lines;
    }

 private:
    std::size_t checks_ = 0;
    std::vector<Finding> findings_;
};

}  // namespace mir::validation
