// SPDX-License-Identifier: MIT
#pragma once

#include "mir/compare/flip.hpp"
#include "mir/compare/metrics.hpp"
#include "mir/io/tone_curve.hpp"
#include "mir/runtime/settings.hpp"
#include "mir/runtime/shard_number.hpp"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace mirtool {

/// Of a progressive `mir render`; none given: a single pass.
struct PassOptions {
    std::optional<std::uint32_t> passes;
    std::optional<double> seconds;         ///< time limit
    std::optional<double> relative_error;  ///< wanted
    std::optional<double> save_every;      ///< seconds; none: 10
    bool resume = false;                   ///< keep a journal and go on from it
};

/// What a file may lack: light, something to stand on, a view.
struct AddedScene {
    std::optional<mir::DVec3> sun;      ///< direction to it, of any length but 0
    float sun_irradiance = 3.0f;        ///< of a surface that faces it, W m^-2
    bool ground = false;                ///< a floor below everything
    std::optional<mir::DVec3> eye;      ///< place of the camera in the file, metres
    std::optional<mir::DVec3> look_at;  ///< what is in the middle; none: the middle of the scene
    float fov = 45.0f;                  ///< vertical, degrees
};

/// Light from all around that the command line puts around a scene.
struct EnvironmentOptions {
    std::string file;  ///< EXR; empty: none
    float scale = 1.0f;
    float rotation = 0.0f;  ///< degrees
};

/// `mir render`.
struct RenderOptions {
    std::string scene;
    EnvironmentOptions environment;
    std::string output;            ///< EXR; empty: named after the scene
    std::string preview;           ///< PNG; empty: beside the EXR
    std::string report;            ///< HTML; empty: none
    std::string report_reference;  ///< EXR to compare the report's picture with; empty: none
    std::string vpls_out;          ///< PLY or .glb of the VPLs; empty: none
    std::string camera;            ///< name or index; empty: the first
    std::optional<std::uint32_t> width;
    std::optional<std::uint32_t> height;
    std::vector<std::string> layers{"albedo", "normal", "depth"};
    std::optional<float> exposure;              ///< EV of the preview; none: automatic
    mir::ToneCurve tone = mir::ToneCurve::agx;  ///< of the preview
    bool no_layers = false;                     ///< --aov none
    bool no_preview = false;
    bool record_seconds = false;  ///< seconds in the EXR: its bytes then differ every time
    bool quiet = false;
    bool json = false;
    bool denoise = false;
    std::string denoiser;                   ///< library; empty: found
    bool has_filter = false;                ///< --filter was given
    std::optional<mir::ShardNumber> shard;  ///< part of the picture to render; none: all
    std::vector<std::string> words;         ///< of the command line, for a shard
    PassOptions passes;
    AddedScene added;
    mir::RenderSettings settings;
};

/// `mir merge`.
struct MergeOptions {
    std::vector<std::string> shards;
    std::string output;   ///< EXR; empty: named after the scene
    std::string preview;  ///< PNG; empty: beside the EXR
    bool no_preview = false;
    bool quiet = false;
    bool json = false;
};

/// `mir info`.
struct InfoOptions {
    std::string scene;
    EnvironmentOptions environment;
    bool accel = false;  ///< build the kd-tree and tell about it
    bool json = false;
    mir::Limits limits;
};

/// `mir export`.
struct ExportOptions {
    std::string scene;
    std::string output;
    mir::Limits limits;
};

/// `mir compare`.
struct CompareOptions {
    std::string image;
    std::string reference;
    std::string second_reference;  ///< independent of the first; empty: none
    std::string layer;             ///< empty: the beauty
    std::string report;            ///< HTML; empty: none
    std::string error;             ///< PNG or EXR of the signed error; empty: none
    double epsilon = mir::default_rel_mse_epsilon;
    float pixels_per_degree = mir::default_pixels_per_degree;
    std::optional<float> exposure;  ///< EV of pictures and LDR-FLIP; none: automatic
    std::optional<double> max_rmse;
    std::optional<double> max_relmse;
    std::optional<double> max_flip;
    std::optional<double> max_mean_difference;  ///< percent
    bool json = false;
};

/// `mir denoise`.
struct DenoiseOptions {
    std::string image;
    std::string output;
    std::string reference;  ///< EXR; empty: none
    std::string denoiser;   ///< library; empty: found
    std::uint32_t threads = 0;
    bool json = false;
    bool quiet = false;
};

/// `mir devices`.
struct DevicesOptions {
    bool json = false;
};

/// `mir manual`.
struct ManualOptions {
    enum class Language { man, bash, zsh, fish };

    Language language = Language::man;
};

using Command = std::variant<RenderOptions, MergeOptions, InfoOptions, ExportOptions,
                             CompareOptions, DenoiseOptions, DevicesOptions, ManualOptions>;

}  // namespace mirtool
