// SPDX-License-Identifier: MIT
#pragma once

#include "picture_words.hpp"
#include "prepare_scene.hpp"
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

/// Declares what renders.
void bind_render(nanobind::module_& m);

}  // namespace mirpy
