// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/light_source.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace mir {

/// A light of one of several kinds, as kernels read it. Its bytes, and which kind they are.
template <LightSource... Sources>
class AnySource {
 public:
    AnySource() = default;

    /// Of one of the kinds.
    template <class Source>
        requires(std::is_same_v<Source, Sources> || ...)
    AnySource(const Source& source) : kind_(index_of<Source>()) {
        std::memcpy(words_, &source, sizeof source);
    }

    /// f(source) of the light as what it is; the same type for all kinds.
#if defined(__CUDACC__)
#pragma nv_exec_check_disable
#endif
    template <class F>
    [[nodiscard]] MIR_HD auto visit(const F& f) const {
        return visit_from<F, Sources...>(f, kind_);
    }

 private:
    template <class Source>
    static constexpr std::uint32_t index_of() {
        const std::array is_it{std::is_same_v<Source, Sources>...};
        return static_cast<std::uint32_t>(std::find(is_it.begin(), is_it.end(), true) -
                                          is_it.begin());
    }
#if defined(__CUDACC__)
#pragma nv_exec_check_disable
#endif
    template <class F, class First, class... Rest>
    [[nodiscard]] MIR_HD auto visit_from(const F& f, std::uint32_t kind) const {
        if constexpr (sizeof...(Rest) > 0)
            if (kind != 0) return visit_from<F, Rest...>(f, kind - 1);
        First source;
        memcpy(&source, words_, sizeof source);
        return f(source);
    }

    static constexpr std::size_t bytes = std::max({sizeof(Sources)...});
    static_assert(((alignof(Sources) == 4) && ...), "mir: kinds of light are kept in words");

    std::uint32_t kind_ = 0;
    std::uint32_t words_[bytes / 4] = {};
};

}  // namespace mir
