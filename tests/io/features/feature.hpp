// SPDX-License-Identifier: MIT
#pragma once

#include "io/gltf_fixture.hpp"
#include "mir/io/scene_reader.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/// A catalogue of what scene files can say, each with the smallest files that say it and with what
/// becomes of it. The tests read the files; the page docs/scene_files.md shows the catalogue.
namespace mirtest::features {

/// Files of one folder. `scene` names the one that is read.
struct Files {
    std::map<std::string, std::string> bytes_of;
    std::string scene;
};

/// Looks at what was read.
using Check = std::function<void(const mir::LoadedScene&)>;

/// What becomes of a file.
struct Outcome {
    enum class Kind { read, without_effect, counted, noted, refused };

    Kind kind = Kind::read;
    /// Of SceneReport::ignored all, of its notes one, of a message a part.
    std::vector<std::string> phrases;
    Check check;                                          ///< none: there is nothing more to ask
    Files plain;                                          ///< of what has no effect: without it
    mir::ErrorCode code = mir::ErrorCode::invalid_input;  ///< of what is refused
};

inline Outcome read(Check check) { return {Outcome::Kind::read, {}, std::move(check), {}}; }
inline Outcome without_effect(Files plain) {
    return {Outcome::Kind::without_effect, {}, {}, std::move(plain)};
}
inline Outcome counted(std::vector<std::string> phrases, Check check = {}) {
    return {Outcome::Kind::counted, std::move(phrases), std::move(check), {}};
}
inline Outcome noted(const std::string& phrase, Check check) {
    return {Outcome::Kind::noted, {phrase}, std::move(check), {}};
}
inline Outcome refused(const std::string& phrase,
                       mir::ErrorCode code = mir::ErrorCode::invalid_input) {
    return {Outcome::Kind::refused, {phrase}, {}, {}, code};
}

/// A row of the page. Texts are Markdown.
struct Feature {
    std::string name;
    std::string says;             ///< how a file says it
    std::vector<Files> variants;  ///< each has the same outcome
    Outcome outcome;
    std::string words;  ///< of the page, behind the outcome
};

using Features = std::vector<Feature>;

/// A row of extensions of glTF: a file may use or require them.
struct Extension {
    std::string name;
    std::string about;
    Files used;  ///< under extensionsUsed
    Files required;
    Outcome when_used;
    Outcome when_required;
    std::string words;
};

inline void append(Features& to, Features more) {
    for (Feature& feature : more) to.push_back(std::move(feature));
}

inline mir::LoadedScene load(const Files& files) {
    const TemporaryFolder folder("features");
    const auto inside = folder / "folder";
    for (const auto& [name, bytes] : files.bytes_of) {
        std::filesystem::create_directories((inside / name).parent_path());
        write_file(inside / name, bytes);
    }
    return mir::read_scene(inside / files.scene);
}

// --- looking at a scene ------------------------------------------------------------------------

/// What a picture is made of, as text.
inline std::string picture_of(const mir::Scene& scene) {
    std::ostringstream text;
    const auto put = [&](const auto&... values) { ((text << values << ' '), ...); };
    const auto texture = [&](const mir::Texture& t) {
        put(t.image, int(t.wrap_u), int(t.wrap_v), t.nearest, t.u_axis.x, t.u_axis.y, t.v_axis.x,
            t.v_axis.y, t.offset.x, t.offset.y);
    };
    for (const mir::Material& m : scene.materials) {
        put(m.base_color.r, m.base_color.g, m.base_color.b, m.metallic, m.roughness, m.specular,
            m.ior, m.emission.r, m.emission.g, m.emission.b, m.emits_from_both_sides, m.light_group,
            m.alpha, m.alpha_cutoff, m.textures.normal_scale);
        for (const auto& t : {m.textures.base_color, m.textures.metallic_roughness,
                              m.textures.normal, m.textures.emission})
            texture(t);
    }
    for (const mir::Mesh& m : scene.meshes) {
        put("mesh", m.material);
        for (const auto& list : {m.positions, m.normals})
            for (const mir::Vec3 v : list) put(v.x, v.y, v.z);
        for (const mir::TriangleIndices& t : m.triangles) put(t[0], t[1], t[2]);
        for (const mir::Vec2 v : m.texture_coordinates) put(v.x, v.y);
        for (const mir::Rgb c : m.colors) put(c.r, c.g, c.b);
    }
    for (const mir::Instance& i : scene.instances) put("copy", i.mesh, i.to_world[3][0]);
    for (const mir::TextureImage& i : scene.images)
        for (const std::uint32_t texel : i.texels) put(texel);
    put(scene.cameras.size(), scene.point_lights.size(), scene.spot_lights.size(),
        scene.directional_lights.size());
    return text.str();
}

inline Check triangles(std::uint64_t count) {
    return [count](const mir::LoadedScene& loaded) { CHECK(loaded.report.triangles == count); };
}

/// Looks at where the first vertex of the only instance stands.
inline Check first_vertex(mir::Vec3 place) {
    return [place](const mir::LoadedScene& loaded) {
        const mir::Instance& i = loaded.scene.instances.at(0);
        const mir::Vec3 p = loaded.scene.meshes.at(i.mesh).positions.at(0);
        CHECK(distance(mir::Vec3(i.to_world * mir::Vec4(p, 1.0f)), place) < 1e-6f);
    };
}

/// Looks at the only mesh.
inline Check mesh(const std::function<void(const mir::Mesh&)>& look) {
    return [look](const mir::LoadedScene& loaded) {
        REQUIRE(loaded.scene.meshes.size() == 1);
        look(loaded.scene.meshes[0]);
    };
}

/// Looks at the material of the first mesh.
inline Check material(const std::function<void(const mir::Material&)>& look) {
    return [look](const mir::LoadedScene& loaded) {
        REQUIRE_FALSE(loaded.scene.meshes.empty());
        look(loaded.scene.materials.at(loaded.scene.meshes[0].material));
    };
}

// --- checking an outcome -----------------------------------------------------------------------

inline void check_refused(const Files& files, const Outcome& expected) {
    mir::ErrorCode code = mir::ErrorCode::internal;
    const std::string message = message_of([&] { (void)load(files); }, &code);
    INFO(message);
    CHECK(message.find(expected.phrases.at(0)) != std::string::npos);
    CHECK(code == expected.code);
}

inline void check_outcome(const Files& files, const Outcome& expected) {
    using Kind = Outcome::Kind;
    if (expected.kind == Kind::refused) return check_refused(files, expected);
    const mir::LoadedScene loaded = load(files);
    std::set<std::string> counts;
    for (const auto& [what, times] : loaded.report.ignored) counts.insert(what);
    const auto& phrases = expected.phrases;
    const bool counts_them = expected.kind == Kind::counted;
    CHECK(counts == (counts_them ? std::set<std::string>(phrases.begin(), phrases.end())
                                 : std::set<std::string>()));
    if (expected.kind == Kind::noted) {
        const auto& notes = loaded.report.notes;
        CHECK(std::find(notes.begin(), notes.end(), phrases.at(0)) != notes.end());
    }
    if (expected.kind == Kind::without_effect)
        CHECK(picture_of(loaded.scene) == picture_of(load(expected.plain).scene));
    if (expected.check) expected.check(loaded);
}

/// Checks every variant of every row.
inline void check_all(const Features& list) {
    for (const Feature& feature : list)
        for (std::size_t k = 0; k < feature.variants.size(); ++k) {
            INFO(feature.name << ", variant " << k);
            check_outcome(feature.variants[k], feature.outcome);
        }
}

// --- the page ----------------------------------------------------------------------------------

inline std::string in_backquotes(const std::vector<std::string>& phrases) {
    std::string text;
    for (const std::string& phrase : phrases) text += (text.empty() ? "`" : ", `") + phrase + "`";
    return text;
}

inline std::string outcome_text(const Outcome& outcome) {
    switch (outcome.kind) {
        case Outcome::Kind::read:
            return "read";
        case Outcome::Kind::without_effect:
            return "no effect";
        case Outcome::Kind::counted:
            return "counted: " + in_backquotes(outcome.phrases);
        case Outcome::Kind::noted:
            return "read, with a note: " + in_backquotes(outcome.phrases);
        default:
            return "refused: " + in_backquotes(outcome.phrases);
    }
}

inline std::string with_words(const std::string& outcome, const std::string& words) {
    return words.empty() ? outcome : outcome + "; " + words;
}

inline std::string table_of(const Features& features) {
    std::string text = "| Feature | The file says | What becomes of it |\n|---|---|---|\n";
    for (const Feature& f : features)
        text += "| " + f.name + " | " + f.says + " | " +
                with_words(outcome_text(f.outcome), f.words) + " |\n";
    return text;
}

inline std::string table_of(const std::vector<Extension>& extensions) {
    std::string text = "| Extension | used | required |\n|---|---|---|\n";
    for (const Extension& e : extensions) {
        const std::string used = outcome_text(e.when_used);
        const std::string required = outcome_text(e.when_required);
        text += "| " + e.name + (e.about.empty() ? "" : ": " + e.about) + " | " +
                with_words(used, e.words) + " | " + (required == used ? "same" : required) + " |\n";
    }
    return text;
}

}  // namespace mirtest::features
