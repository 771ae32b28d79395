// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/monitor.hpp"
#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"
#include "mir/scene/scene.hpp"

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mir {

class PictureShare;

/// A compiled way to render: one virtual call per image, static inside.
class Renderer {
 public:
    virtual ~Renderer() = default;

    /// Renders `scene`. `monitor` may be null. Safe to call from several threads on one object.
    /// @throws Error for settings, scene or device that cannot be used; Error(cancelled).
    virtual RenderResult render(const Scene& scene, const RenderSettings& settings,
                                Monitor* monitor) const = 0;

    /// The same, of the part that this process has in a picture of several (PictureTeam). Only a
    /// team has shares to give.
    /// @throws The same; Error(unsupported) where it is not overridden.
    virtual RenderResult render_share(const Scene& /*scene*/, const RenderSettings& /*settings*/,
                                      Monitor* /*monitor*/, PictureShare& /*share*/) const {
        throw Error(ErrorCode::unsupported,
                    "this renderer makes whole pictures alone (its work cannot be shared out among "
                    "processes); let each process render pictures of its own");
    }
};

/// Renderers by backend and name of the scheduler. Filled explicitly: self-registering objects
/// vanish from static libraries. Const use from any thread.
class Registry {
 public:
    using Factory = std::function<std::unique_ptr<Renderer>()>;  ///< makes one more renderer

    /// A machine with its renderers.
    struct Backend {
        BackendKind kind = BackendKind::cpu;  ///< which machine; not automatic
        std::string name;                     ///< as users write it
        std::function<void()> require;  ///< throws Error(no_device) where there is no such machine
        std::string default_scheduler;  ///< one of `schedulers`
        std::map<std::string, Factory, std::less<>> schedulers;  ///< by name, as users write it
        /// Why it cannot render such settings, empty where it can; null: it can render all.
        std::function<std::string(const RenderSettings&)> refuses = nullptr;
        /// Whether something of the machine is there, though it may be unusable; null: it is.
        std::function<bool()> is_present = nullptr;
    };

    /// A renderer, and a sentence for each present machine that was passed over.
    struct Choice {
        std::unique_ptr<Renderer> renderer;  ///< never null
        std::vector<std::string> remarks;    ///< of BackendKind::automatic alone
    };

    /// Backends that are added first are preferred by BackendKind::automatic.
    void add(Backend backend) { backends_.push_back(std::move(backend)); }

    /// The renderer of a backend with a scheduler, or with its default one.
    /// @throws Error(unsupported) with the list of names when there is none; Error(no_device) when
    /// the backend's machine is missing.
    [[nodiscard]] std::unique_ptr<Renderer> make(BackendKind kind,
                                                 std::string_view scheduler) const {
        const Backend& backend = choose(kind, scheduler);
        const std::string_view name = scheduler.empty() ? backend.default_scheduler : scheduler;
        return backend.schedulers.find(name)->second();
    }

    /// The renderer of the first backend that can render these settings. Backends that are not
    /// there, or that the settings exclude, are passed over.
    /// @throws what make() throws.
    [[nodiscard]] Choice make_for(const RenderSettings& settings) const {
        Choice choice;
        if (settings.backend == BackendKind::automatic)
            for (const Backend& b : backends_) {
                if (!offers(b, settings.scheduler)) continue;
                const std::string reason = reason_against(b, settings);
                if (reason.empty())
                    return {make(b.kind, settings.scheduler), std::move(choice.remarks)};
                if (!b.is_present || b.is_present())
                    choice.remarks.push_back("backend " + b.name + " was not used: " + reason);
            }
        choice.renderer = make(settings.backend, settings.scheduler);
        return choice;
    }

    /// Names of a backend's schedulers, or of all, separated by commas. Each occurs once.
    [[nodiscard]] std::string names(BackendKind kind = BackendKind::automatic) const {
        std::set<std::string> names;
        for (const Backend& b : backends_)
            if (kind == BackendKind::automatic || kind == b.kind)
                for (const auto& [name, factory] : b.schedulers) names.insert(name);
        std::string all;
        for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
        return all;
    }

 private:
    [[nodiscard]] static bool offers(const Backend& backend, std::string_view scheduler) {
        return scheduler.empty() || backend.schedulers.contains(scheduler);
    }
    [[nodiscard]] static bool is_there(const Backend& backend) {
        try {
            backend.require();
            return true;
        } catch (const Error&) {
            return false;
        }
    }
    /// Empty where the backend can render.
    [[nodiscard]] static std::string reason_against(const Backend& backend,
                                                    const RenderSettings& settings) {
        try {
            backend.require();
        } catch (const Error& e) {
            return e.what();
        }
        return backend.refuses ? backend.refuses(settings) : "";
    }

    [[nodiscard]] const Backend& choose(BackendKind kind, std::string_view scheduler) const {
        bool built = false;
        for (const Backend& b : backends_) {
            if (kind != BackendKind::automatic && kind != b.kind) continue;
            built = true;
            if (!offers(b, scheduler)) continue;
            if (kind != BackendKind::automatic)
                b.require();
            else if (!is_there(b))
                continue;
            return b;
        }
        if (!built)
            throw Error(ErrorCode::no_device,
                        "this build has no such backend (it was configured without it); build it "
                        "in, or use --backend cpu");
        const char* where =
            kind == BackendKind::automatic ? "' in this build" : "' for this backend";
        throw Error(ErrorCode::unsupported, "there is no scheduler '" + std::string(scheduler) +
                                                where + "; choose one of " + names(kind));
    }

    std::vector<Backend> backends_;
};

}  // namespace mir
