// SPDX-License-Identifier: MIT
#include "team.hpp"

#include "errors.hpp"
#include "mir/runtime/picture_team.hpp"
#include "py_peers.hpp"
#include "render.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <utility>

namespace nb = nanobind;

namespace mirpy {
namespace {

/// A team for one picture.
class PyTeam {
 public:
    explicit PyTeam(nb::object carrier)
        : peers_(std::move(carrier)), team_(std::in_place, peers_) {}

    [[nodiscard]] std::unique_ptr<PyResult> render(PyScene& scene,
                                                   const std::vector<std::string>& words,
                                                   nb::handle progress) {
        return render_watched(scene, words, progress, &*team_);
    }
    /// Tells the others why this process cannot go on, unless they know.
    void fail(const std::string& code, const std::string& reason) {
        const mir::Error error(code_named(code), reason);
        const nb::gil_scoped_release release;
        team_->fail(error);
    }
    /// Waits until all others know that there is nothing more to do.
    void leave() {
        const nb::gil_scoped_release release;
        team_.reset();
    }

 private:
    PyPeers peers_;
    std::optional<mir::PictureTeam> team_;
};

}  // namespace

void bind_team(nb::module_& m) {
    nb::class_<PyTeam>(m, "_Team")
        .def(nb::init<nb::object>())
        .def("render", &PyTeam::render, nb::arg("scene"), nb::arg("words"),
             nb::arg("progress").none())
        .def("fail", &PyTeam::fail, nb::arg("code"), nb::arg("reason"))
        .def("leave", &PyTeam::leave);
}

}  // namespace mirpy
