// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_check.hpp"
#include "io/detail/gltf_json.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mir::detail {

/// What a value of JSON is, as part of a sentence.
inline std::string json_kind(const Json& json) {
    switch (json.type()) {
        case Json::value_t::null:
            return "null";
        case Json::value_t::object:
            return "an object";
        case Json::value_t::array:
            return "an array";
        case Json::value_t::string:
            return "text";
        case Json::value_t::boolean:
            return json.get<bool>() ? "true" : "false";
        default:
            return json.dump();
    }
}

/// A name, which is for people alone. Of another type it is as good as none.
inline std::string json_name(const Json& json) {
    if (!json.is_object()) return {};
    const auto found = json.find("name");
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// A value of the file's JSON and the path to it. Asks for the type that the caller needs and
/// complains with the whole path. The JSON must outlive it.
class GltfValue {
 public:
    explicit GltfValue(const Json& root) : json_(&root) {}

    [[nodiscard]] const Json& json() const { return *json_; }
    [[nodiscard]] std::string name() const { return json_name(*json_); }

    /// Member `key`, nothing when it is not there.
    /// @throws Error(invalid_input) when this is no object.
    [[nodiscard]] std::optional<GltfValue> find(const char* key) const {
        if (!json_->is_object()) fail_type("an object");
        const auto found = json_->find(key);
        if (found == json_->end()) return std::nullopt;
        return step(*found, {found.key().c_str(), nowhere, nullptr});
    }

    /// Member `key`. @throws Error(invalid_input) when it is not there.
    [[nodiscard]] GltfValue need(const char* key, const char* wanted) const {
        if (const auto found = find(key)) return *found;
        const GltfValue missing = step(*json_, {key, nowhere, nullptr});
        missing.fail("is missing, where " + std::string(wanted) +
                     " is wanted (glTF asks for it); repair or export it again");
    }

    /// Element `index` of an array. @pre it is there.
    [[nodiscard]] GltfValue at(std::size_t index) const {
        return step((*json_)[index], {nullptr, index, nullptr});
    }

    /// This element as a place of its own: "node 3 'lamp'" instead of "nodes[3]".
    [[nodiscard]] GltfValue as(const char* kind, std::size_t index) const {
        GltfValue place = *this;
        place.steps_[place.count_ - 1] = {kind, index, json_};
        // The list that holds it is part of the name.
        return place;
    }

    /// Elements of an array. @throws Error(invalid_input) when this is none.
    [[nodiscard]] std::size_t size() const {
        if (!json_->is_array()) fail_type("an array");
        return json_->size();
    }

    [[nodiscard]] double number() const {
        if (!json_->is_number()) fail_type("a number");
        return json_->get<double>();
    }

    /// So many numbers, any number of them when `count` is 0.
    [[nodiscard]] std::vector<double> numbers(std::size_t count) const;

    [[nodiscard]] const std::string& text() const {
        if (!json_->is_string()) fail_type("text");
        return json_->get_ref<const std::string&>();
    }

    [[nodiscard]] bool truth() const {
        if (!json_->is_boolean()) fail_type("true or false");
        return json_->get<bool>();
    }

    /// A whole number of 0..`most`; 1.0 is one.
    [[nodiscard]] std::uint64_t whole(std::uint64_t most) const;

    /// An index into a list of `count` things called `kind`.
    [[nodiscard]] int index(const char* kind, std::size_t count) const;

    /// at(i).index(kind, count), without a path while it is good: lists can be long.
    [[nodiscard]] int index_at(std::size_t i, const char* kind, std::size_t count) const {
        const Json& element = (*json_)[i];
        if (element.is_number_unsigned() && element.get<std::uint64_t>() < count)
            return element.get<int>();
        return at(i).index(kind, count);
    }

    /// @throws Error(invalid_input) "PLACE: PATH problem".
    [[noreturn]] void fail(const std::string& problem) const {
        const auto [place, path] = where(count_);
        const std::string subject = path.empty() ? "it" : path;
        throw Error(ErrorCode::invalid_input,
                    (place.empty() ? "" : place + ": ") + subject + " " + problem);
    }

    [[noreturn]] void fail_type(const char* wanted) const {
        fail("is " + json_kind(*json_) + ", where " + wanted + " is wanted (" +
             (json_->is_null() ? "exporters in JavaScript write null for NaN"
                               : "glTF knows no other type there") +
             "); repair or export it again");
    }

 private:
    /// A key, an element of an array, or a place with `named`.
    struct Step {
        const char* name = nullptr;
        std::size_t index = 0;
        const Json* named = nullptr;
    };
    struct Location {
        std::string place;  ///< "node 3 'lamp'"
        std::string path;   ///< "translation[0]"
    };
    static constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

    [[nodiscard]] GltfValue step(const Json& json, Step to) const {
        GltfValue next = *this;
        next.json_ = &json;
        if (next.count_ < next.steps_.size()) next.steps_[next.count_++] = to;
        return next;
    }

    [[nodiscard]] Location where(std::size_t count) const;

    const Json* json_;
    std::array<Step, 10> steps_;  ///< more than the deepest property that is read
    std::size_t count_ = 0;
};

inline GltfValue::Location GltfValue::where(std::size_t count) const {
    Location at;
    for (std::size_t i = 0; i < count; ++i) {
        const Step& step = steps_[i];
        if (step.named != nullptr) {
            at.place += (at.place.empty() ? "" : ", ") +
                        gltf_place(step.name, step.index, json_name(*step.named));
            at.path.clear();
        } else if (step.name != nullptr) {
            at.path += (at.path.empty() ? "" : ".") + std::string(step.name);
        } else {
            at.path += "[" + std::to_string(step.index) + "]";
        }
    }
    return at;
}

inline std::vector<double> GltfValue::numbers(std::size_t count) const {
    const std::size_t found = size();
    if (count != 0 && found != count)
        fail("has " + std::to_string(found) + " numbers instead of " + std::to_string(count) +
             "; repair it");
    std::vector<double> values(found);
    for (std::size_t i = 0; i < found; ++i) {
        const Json& element = (*json_)[i];
        values[i] = element.is_number() ? element.get<double>() : at(i).number();
    }
    return values;
}

inline std::uint64_t GltfValue::whole(std::uint64_t most) const {
    if (!json_->is_number()) fail_type("a whole number");
    std::uint64_t value = 0;
    bool is_whole = false;
    if (json_->is_number_unsigned()) {
        value = json_->get<std::uint64_t>();
        is_whole = true;
    } else if (json_->is_number_float()) {
        const double given = json_->get<double>();
        // 2^64 itself is out of range.
        is_whole = given >= 0.0 && given < 18446744073709551616.0 && given == std::floor(given);
        if (is_whole) value = static_cast<std::uint64_t>(given);
    }
    if (!is_whole || value > most)
        fail("is " + json_->dump() + ", where a whole number is wanted (not negative, at most " +
             std::to_string(most) + "); repair or export it again");
    return value;
}

inline int GltfValue::index(const char* kind, std::size_t count) const {
    if (!json_->is_number()) fail_type("a whole number");
    constexpr auto largest = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
    const double given = json_->get<double>();
    if (given != std::floor(given))
        fail("is " + json_->dump() +
             ", where a whole number is wanted (it is an index); repair or export it again");
    if (given >= 0.0 && given < static_cast<double>(count) && given <= static_cast<double>(largest))
        return static_cast<int>(given);
    const Step& last = steps_[count_ - 1];
    const bool is_element = last.name == nullptr && count_ > 1;
    const Location parent = where(is_element ? count_ - 2 : count_ - 1);
    const std::string own =
        is_element ? steps_[count_ - 2].name + ("[" + std::to_string(last.index) + "]") : last.name;
    std::string place = parent.place;
    if (!parent.path.empty()) place += (place.empty() ? "" : ", ") + parent.path;
    gltf_fail(place.empty() ? own : place, "it names " + std::string(kind) + " " + json_->dump() +
                                               " (" + own +
                                               "), which does not exist (the file has " +
                                               std::to_string(count) + "); repair the index");
}

}  // namespace mir::detail
