// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace mirfuzz {

/// Changes a JSON text by its structure, where libFuzzer's own mutations break its syntax: values
/// of other types, numbers at the ends of their types, values shared, repeated, left out, nested. A
/// pure function of text and seed.
class JsonMutator {
 public:
    explicit JsonMutator(std::uint32_t seed) : random_(seed + 1u) {}

    /// Empty when `text` is no JSON.
    [[nodiscard]] std::string operator()(std::string_view text) {
        Json root = Json::parse(text, nullptr, false);
        if (root.is_discarded()) return {};
        for (std::size_t changes = 1 + below(4); changes > 0; --changes) change(root);
        return root.dump(-1, ' ', false, Json::error_handler_t::replace);
    }

 private:
    using Json = nlohmann::ordered_json;

    [[nodiscard]] std::size_t below(std::size_t n) { return random_() % n; }

    static void list(Json& value, std::vector<Json*>& all) {
        all.push_back(&value);
        if (value.is_structured())
            for (Json& child : value) list(child, all);
    }

    void change(Json& root) {
        std::vector<Json*> all;
        list(root, all);
        Json& at = *all[below(all.size())];
        switch (below(6)) {
            case 0:
                at = Json(*all[below(all.size())]);
                break;
            case 1:
                nest(at);
                break;
            case 2:
            case 3:
                if (at.is_array() && !at.empty())
                    change_list(at);
                else if (at.is_object() && !at.empty())
                    change_members(at);
                else if (at.is_number())
                    change_number(at);
                else
                    at = stranger();
                break;
            default:
                at = stranger();
        }
    }

    [[nodiscard]] Json stranger() {
        static const std::vector<Json> strangers{nullptr,
                                                 true,
                                                 "",
                                                 "x",
                                                 Json::array(),
                                                 Json::object(),
                                                 0,
                                                 -1,
                                                 1,
                                                 3,
                                                 255,
                                                 65535,
                                                 2147483647,
                                                 2147483648u,
                                                 -2147483648LL,
                                                 4294967295u,
                                                 4294967296ull,
                                                 -9223372036854775807LL,
                                                 18446744073709551615ull,
                                                 0.5,
                                                 -0.0,
                                                 1e-320,
                                                 1e38,
                                                 3.5e38,
                                                 1e300,
                                                 "data:,",
                                                 Json::array({0, 0, 0}),
                                                 Json::array({nullptr})};
        return strangers[below(strangers.size())];
    }

    void nest(Json& at) {
        const std::size_t levels = below(8) == 0 ? 250 : 1 + below(3);
        for (std::size_t i = 0; i < levels; ++i) {
            Json outer = Json::array();
            outer.push_back(std::move(at));
            at = std::move(outer);
        }
    }

    void change_list(Json& at) {
        const std::size_t i = below(at.size());
        if (below(2) == 0) {
            at.erase(i);
            return;
        }
        const std::size_t times = below(8) == 0 ? 500 : 1 + below(4);
        const Json again = at[i];
        for (std::size_t k = 0; k < times; ++k) at.push_back(again);
    }

    void change_members(Json& at) {
        auto member = at.begin();
        std::advance(member, static_cast<std::ptrdiff_t>(below(at.size())));
        const std::string key = member.key();
        if (below(2) == 0)
            at[key + "_"] = member.value();
        else
            at.erase(key);
    }

    void change_number(Json& at) {
        const double value = at.get<double>();
        switch (below(4)) {
            case 0:
                at = value + 1.0;
                break;
            case 1:
                at = -value;
                break;
            case 2:
                at = value * 1024.0;
                break;
            default:
                at = static_cast<std::int64_t>(below(16));
        }
    }

    std::minstd_rand random_;
};

}  // namespace mirfuzz
