// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

namespace mir {

/// Seconds of wall time spent in each stage of a render. No moment counts twice: `total` is the sum
/// of all others.
struct StageSeconds {
    double geometry = 0.0;        ///< triangles in world space, lights, materials
    double build = 0.0;           ///< acceleration structure
    double upload = 0.0;          ///< the scene to the backend's memory
    double bound = 0.0;           ///< what the camera sees, for the bound
    double bootstrap = 0.0;       ///< P_c and the starts of Markov chains
    double sampling = 0.0;        ///< VPLs, from there; light of discs
    double surfels = 0.0;         ///< discs and their hierarchy
    double paths = 0.0;           ///< camera paths of the reference
    double gbuffer = 0.0;         ///< camera rays
    double visibility = 0.0;      ///< stored visibility: shadow rays, where they are kept
    double response = 0.0;        ///< what each VPL does to the image, and intensities from it
    double direct = 0.0;          ///< next-event light, emission
    double reconstruction = 0.0;  ///< contributions of the VPLs
    double gather = 0.0;          ///< light from discs
    double light_budget = 0.0;    ///< measuring noise, what VPLs leave out, discs differ by
    double residual = 0.0;        ///< tracing that back
    double caustics = 0.0;        ///< light paths through mirrors and glass
    double film = 0.0;            ///< filtering
    double guides = 0.0;          ///< albedo, normal, position and depth
    double download = 0.0;        ///< finished pictures from the backend's memory
    double hash = 0.0;            ///< fingerprint of the scene
    double other = 0.0;           ///< everything else
    double total = 0.0;           ///< sum of all of these
};

/// Which of its stages.
using StageMember = double StageSeconds::*;

/// A stage and its names.
struct RenderStage {
    std::string_view name;  ///< key in files
    StageMember seconds;    ///< where its time stands
    const char* title;      ///< what a person reads
};

/// Every stage in the order in which a frame goes through them. What they take adds up to
/// StageSeconds::total.
inline constexpr std::array<RenderStage, 22> render_stages{
    {{"geometry", &StageSeconds::geometry, "geometry"},
     {"build", &StageSeconds::build, "acceleration structure"},
     {"upload", &StageSeconds::upload, "upload"},
     {"bound", &StageSeconds::bound, "what the camera sees"},
     {"bootstrap", &StageSeconds::bootstrap, "light paths"},
     {"sampling", &StageSeconds::sampling, "placing light"},
     {"surfels", &StageSeconds::surfels, "discs"},
     {"paths", &StageSeconds::paths, "camera paths"},
     {"gbuffer", &StageSeconds::gbuffer, "camera rays"},
     {"visibility", &StageSeconds::visibility, "shadow rays of VPLs"},
     {"response", &StageSeconds::response, "what each VPL does"},
     {"direct", &StageSeconds::direct, "direct light"},
     {"reconstruction", &StageSeconds::reconstruction, "light of VPLs"},
     {"gather", &StageSeconds::gather, "light of discs"},
     {"light_budget", &StageSeconds::light_budget, "light that is missing"},
     {"residual", &StageSeconds::residual, "light that was removed"},
     {"caustics", &StageSeconds::caustics, "light of mirrors and glass"},
     {"film", &StageSeconds::film, "film"},
     {"guides", &StageSeconds::guides, "albedo and normals"},
     {"download", &StageSeconds::download, "download"},
     {"hash", &StageSeconds::hash, "fingerprint of the scene"},
     {"other", &StageSeconds::other, "preparing"}}};

/// Adds the seconds of each stage, and of all.
inline void add_seconds(StageSeconds& all, const StageSeconds& more) {
    for (const RenderStage& stage : render_stages) all.*stage.seconds += more.*stage.seconds;
    all.total += more.total;
}

/// What a person reads of a stage.
constexpr const char* title_of(StageMember stage) {
    for (const RenderStage& known : render_stages)
        if (known.seconds == stage) return known.title;
    return "";
}

}  // namespace mir
