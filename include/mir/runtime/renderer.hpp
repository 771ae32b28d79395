// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"
#include "mir/scene/scene.hpp"

#include <functional>
#include <map>
#include <memory>
#include <string_view>

namespace mir {

/// A compiled way to render: one virtual call per image, static inside.
class Renderer {
 public:
    virtual ~Renderer() = default;

    /// Renders `scene`. `monitor` may be null. Safe to call from several threads on one object.
    /// @throws Error for settings, scene or device that cannot be used; Error(cancelled).
    virtual RenderResult render(const Scene& scene, const RenderSettings& settings,
                                Monitor* monitor) const = 0;
};

/// Renderers by name. Filled explicitly: self-registering objects vanish from static libraries.
class Registry {
 public:
    using Factory = std::function<std::unique_ptr<Renderer>()>;

    void add(std::string name, Factory make) { factories_[std::move(name)] = std::move(make); }

    /// @throws Error(unsupported) that lists the names when there is none called `name`.
    [[nodiscard]] std::unique_ptr<Renderer> make(std::string_view name) const {
        const auto found = factories_.find(name);
        if (found != factories_.end()) return found->second();
        throw Error(ErrorCode::unsupported, "there is no scheduler '" + std::string(name) +
                                                "' in this build; choose one of " + names());
    }

    /// The names, separated by commas.
    [[nodiscard]] std::string names() const {
        std::string all;
        for (const auto& [name, factory] : factories_) all += (all.empty() ? "" : ", ") + name;
        return all;
    }

 private:
    std::map<std::string, Factory, std::less<>> factories_;
};

}  // namespace mir
