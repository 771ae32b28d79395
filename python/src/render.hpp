// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/picture_team.hpp"
#include "picture_words.hpp"
#include "prepare_scene.hpp"
#include "result.hpp"
#include "scene.hpp"

#include <nanobind/nanobind.h>

#include <memory>
#include <string>
#include <vector>

namespace mirpy {

/// A scene that is held, and what a picture of it is to be. To be made and to end with the GIL
/// held.
class Job {
 public:
    /// `words` are those of the command line.
    /// @throws mir::Error for words that cannot be used.
    Job(PyScene& scene, const std::vector<std::string>& words);

    /// Makes the scene ready. Needs no GIL.
    /// @throws mir::Error for a scene that cannot be rendered.
    void prepare();
    /// The scene that is rendered, once prepared.
    [[nodiscard]] const mir::Scene& scene() const { return loaded_->scene; }
    /// What is known of it, once prepared.
    [[nodiscard]] const mir::SceneReport& report() const { return loaded_->report; }

 private:
    PyScene::Hold hold_;
    std::shared_ptr<PyScene::Loaded> loaded_;

 public:
    mirtool::RenderOptions options;  ///< prepare() chooses camera and size where they are left open
};

/// Renders, with the other processes of `team` unless that is null. Null where another process has
/// the picture. `progress` is that of watched().
std::unique_ptr<PyResult> render_watched(PyScene& scene, const std::vector<std::string>& words,
                                         nanobind::handle progress, mir::PictureTeam* team);

/// Declares what renders.
void bind_render(nanobind::module_& m);

}  // namespace mirpy
