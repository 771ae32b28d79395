// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/runtime/peers.hpp"
#include "mir/runtime/picture_keeper.hpp"
#include "mir/runtime/renderer.hpp"

#include <memory>

namespace mir {

/// Pictures that several processes make together, in every bit those of one. Each process has the
/// whole scene. The lead (Peers::rank() 0) deals bands of rows to whoever is free and adds up what
/// they find, in the order of the rows. The lead calls render() once for each picture, all others
/// call work() once. Of mir::runtime. One thread at a time, the one that may use the peers.
class PictureTeam {
 public:
    /// `peers` must outlive it.
    explicit PictureTeam(Peers& peers);
    PictureTeam(const PictureTeam&) = delete;
    PictureTeam& operator=(const PictureTeam&) = delete;
    /// At the lead: tells all others that there is nothing more to do, and waits for them.
    ~PictureTeam();

    /// True for the process that gets the pictures.
    [[nodiscard]] bool is_lead() const;

    /// From now on keeps pictures under way, at the lead. Goes on from one that was kept, if it is
    /// of the same scene, settings and program. `keeper` must outlive the last render().
    void keep_in(PictureKeeper& keeper);

    /// Renders with the others, at the lead. Numbers of the result are of the whole picture; its
    /// seconds are those of the lead.
    /// @throws Error as Renderer::render(), also where another process failed: then nobody can
    ///         render with this team any more.
    [[nodiscard]] RenderResult render(const Renderer& renderer, const Scene& scene,
                                      const RenderSettings& settings, Monitor* monitor);

    /// Renders what the lead deals, until that has no more pictures. `settings` are the lead's;
    /// threads, devices and tiles may differ. `monitor` may be null.
    /// @throws Error as render(), of whichever process failed.
    void work(const Renderer& renderer, const Scene& scene, const RenderSettings& settings,
              Monitor* monitor);

    /// Tells the team that this process cannot go on. Returns once all know; work() and render() do
    /// that for what they throw.
    void fail(const Error& reason) noexcept;

 private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace mir
