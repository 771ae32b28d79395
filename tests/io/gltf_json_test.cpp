// SPDX-License-Identifier: MIT
#include "io/gltf_everything.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

using namespace mirtest;
using nlohmann::json;
using Pointer = json::json_pointer;

namespace {

mir::LoadedScene read(const json& file, const mir::Limits& limits = {}) {
    return read_text(file.dump(), everything_bytes(), limits);
}

std::string says(const json& file, mir::ErrorCode* code = nullptr) {
    return message_of([&] { (void)read(file); }, code);
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Properties that no picture needs, by the end of their path: of any type and tolerated.
bool is_unused(const std::string& path) {
    static const std::array<const char*, 24> ends = {
        "/name",       "/generator", "/copyright",  "/znear",
        "/zfar",       "/minFilter", "/target",     "/mimeType",
        "/strength",   "/min",       "/max",        "/TANGENT",
        "/skin",       "/skins",     "/joints",     "/range",
        "/resolution", "/extras",    "/animations", "/extensionsUsed",
        "/note",       "/other",     "/whatever",   "/KHR_materials_sheen"};
    static const std::array<const char*, 13> parts = {"/min/",
                                                      "/max/",
                                                      "/skins/",
                                                      "/animations/",
                                                      "/extensionsUsed/",
                                                      "/note/",
                                                      "/other/",
                                                      "/whatever/",
                                                      "/KHR_materials_sheen/",
                                                      "/resolution/",
                                                      "/scenes/0",
                                                      "/occlusionTexture",
                                                      "/JOINTS_0/"};
    const auto ends_so = [&](const std::string& end) {
        return path.size() >= end.size() &&
               path.compare(path.size() - end.size(), end.size(), end) == 0;
    };
    return std::any_of(ends.begin(), ends.end(), ends_so) ||
           std::any_of(parts.begin(), parts.end(),
                       [&](const std::string& part) { return has(path, part); });
}

/// The paths of all values below `value`.
void collect(const json& value, const Pointer& path, std::vector<Pointer>& paths) {
    if (!path.empty()) paths.push_back(path);
    if (value.is_object())
        for (const auto& member : value.items())
            collect(member.value(), path / member.key(), paths);
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i) collect(value[i], path / i, paths);
}

std::vector<json> other_types(const json& value) {
    std::vector<json> others;
    for (const json& other :
         {json(nullptr), json(3), json("text"), json(true), json::array({}), json::object({})})
        if (other.type() != value.type() && !(other.is_number() && value.is_number()))
            others.push_back(other);
    return others;
}

/// The last name on a path, with the number of the element behind it: "translation[0]".
std::string last_name(const Pointer& path) {
    const std::string& last = path.back();
    const bool is_number =
        std::all_of(last.begin(), last.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!is_number) return last;
    return path.parent_pointer().back() + "[" + last + "]";
}

}  // namespace

TEST_CASE("the file that has everything is read") {
    const auto loaded = read(everything_json());
    CHECK(loaded.scene.meshes.size() == 2);
    CHECK(loaded.scene.instances.size() == 4);
    CHECK(loaded.scene.spot_lights.size() == 1);
    CHECK(loaded.scene.cameras.size() == 1);
    CHECK(loaded.scene.images.size() == 1);
    CHECK_FALSE(loaded.report.ignored.contains("skin"));
    CHECK(loaded.report.ignored.at("animation") == 1);
}

TEST_CASE("a property of a wrong type is refused by its path, or not used at all") {
    const json good = everything_json();
    std::vector<Pointer> paths;
    collect(good, Pointer(), paths);
    REQUIRE(paths.size() > 250);
    std::size_t refused = 0;
    for (const Pointer& path : paths)
        for (const json& wrong : other_types(good[path])) {
            json file = good;
            file[path] = wrong;
            mir::ErrorCode code = mir::ErrorCode::internal;
            const std::string message = says(file, &code);
            INFO(path.to_string() << " = " << wrong.dump() << ": " << message);
            if (is_unused(path.to_string())) {
                CHECK(message == "no error");
                continue;
            }
            ++refused;
            CHECK(code == mir::ErrorCode::invalid_input);
            CHECK(has(message, "wanted"));
            CHECK(has(message, "; "));
            // Elements of the file's lists have places of their own: "node 3 'lamp': it is null".
            const bool is_place = has(message, ": it is ");
            CHECK((is_place || has(message, last_name(path) + " ")));
        }
    CHECK(refused > 500);
}

TEST_CASE("a message about a type names place, path, what is there and what is wanted") {
    const auto changed = [](const char* path, const json& value) {
        json file = everything_json();
        file[Pointer(path)] = value;
        return says(file);
    };
    CHECK(has(changed("/nodes/0/translation/0", nullptr),
              "scene.gltf: node 0 'root': translation[0] is null, where a number is wanted "
              "(exporters in JavaScript write null for NaN); repair or export it again"));
    CHECK(has(
        changed("/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", "x"),
        "material 0 'a': extensions.KHR_materials_emissive_strength.emissiveStrength is "
        "text, where a number is wanted"));
    json long_name = everything_json();
    long_name["nodes"][0]["name"] = std::string(119, 'x') + "\xc3\xa4" + std::string(9000, 'y');
    long_name["nodes"][0]["scale"] = nullptr;
    CHECK(has(says(long_name), "node 0 '" + std::string(119, 'x') + "\xc3\xa4" +
                                   std::string(63, 'y') + "... (9121 bytes)': scale is null"));
    CHECK(has(changed("/scene", "hello"), "scene.gltf: scene is text, where a whole number"));
    CHECK(has(changed("/asset/version", 2.0), "asset.version is 2.0, where text is wanted"));
    CHECK(has(changed("/nodes/0/rotation", json::array({1, 2})),
              "node 0 'root': rotation has 2 numbers instead of 4"));
    CHECK(has(changed("/extensions/KHR_lights_punctual/lights/0/color/1", nullptr),
              "light 0 'spot': color[1] is null"));
    CHECK(has(changed("/meshes/0/primitives/0/attributes/POSITION", "0"),
              "mesh 0 'm', primitive 0: attributes.POSITION is text"));
    CHECK(
        has(changed("/materials/0/emissiveFactor", json::array({1, 2})), "2 numbers instead of 3"));
}

TEST_CASE("a whole number may be written as 1.0, and no index is negative, broken or too large") {
    json file = everything_json();
    file["scene"] = 1.0;
    file["nodes"][0]["children"] = {1.0, 2, 3};
    file["accessors"][0]["count"] = 3.0;
    file["accessors"][0]["componentType"] = 5126.0;
    CHECK(says(file) == "no error");
    for (const char* path :
         {"/nodes/0/children/0", "/nodes/1/mesh", "/nodes/2/camera", "/scene",
          "/nodes/3/extensions/KHR_lights_punctual/light", "/meshes/0/primitives/0/indices",
          "/meshes/0/primitives/0/material", "/meshes/0/primitives/0/attributes/NORMAL",
          "/meshes/0/primitives/0/targets/0/POSITION", "/accessors/0/bufferView",
          "/accessors/4/sparse/indices/bufferView", "/bufferViews/0/buffer", "/textures/0/source",
          "/textures/0/sampler", "/images/0/bufferView", "/materials/0/normalTexture/index",
          "/scenes/1/nodes/0",
          "/nodes/1/extensions/EXT_mesh_gpu_instancing/attributes/TRANSLATION"})
        for (const json& wrong : {json(-1), json(99), json(1e300), json(-1e300), json(0.5)}) {
            json broken = everything_json();
            broken[Pointer(path)] = wrong;
            const std::string message = says(broken);
            INFO(path << " = " << wrong << ": " << message);
            CHECK(has(message, last_name(Pointer(path)).substr(0, 6)));
            const bool is_named = has(message, wrong.dump());
            CHECK(is_named);
        }
    for (const char* path :
         {"/accessors/0/count", "/bufferViews/0/byteLength", "/bufferViews/0/byteOffset",
          "/buffers/0/byteLength", "/accessors/4/sparse/count", "/meshes/0/primitives/0/mode"})
        for (const json& wrong : {json(-1), json(1e300), json(0.5)}) {
            json broken = everything_json();
            broken[Pointer(path)] = wrong;
            const std::string message = says(broken);
            INFO(path << " = " << wrong << ": " << message);
            CHECK(has(message, last_name(Pointer(path)) + " is " + wrong.dump()));
        }
}

TEST_CASE("what glTF asks for and is missing is named") {
    for (const char* path :
         {"/asset", "/asset/version", "/cameras/0/type", "/cameras/0/perspective",
          "/cameras/0/perspective/yfov", "/extensions/KHR_lights_punctual/lights/0/type",
          "/accessors/0/count", "/accessors/0/type", "/accessors/0/componentType",
          "/bufferViews/0/buffer", "/bufferViews/0/byteLength", "/buffers/0/byteLength",
          "/accessors/4/sparse/values", "/materials/0/normalTexture/index"}) {
        json file = everything_json();
        const Pointer at(path);
        file[at.parent_pointer()].erase(at.back());
        const std::string message = says(file);
        INFO(path << ": " << message);
        CHECK(has(message, at.back() + " is missing, where "));
    }
}

TEST_CASE("things that nothing uses may be of any type") {
    json file = everything_json();
    file["nodes"].push_back({{"translation", {nullptr, 0, 0}}, {"mesh", "x"}});
    file["nodes"].push_back(nullptr);
    file["materials"].push_back({{"emissiveFactor", "white"}});
    file["materials"].push_back(7);
    file["meshes"].push_back({{"primitives", 3}});
    file["meshes"].push_back(nullptr);
    file["cameras"].push_back({{"type", 3}});
    file["textures"].push_back({{"source", "x"}});
    file["samplers"].push_back(nullptr);
    file["images"].push_back({{"uri", nullptr}});
    file["accessors"].push_back({{"count", "many"}});
    file["bufferViews"].push_back(nullptr);
    file["buffers"].push_back({{"byteLength", 8}, {"uri", "not there.bin"}});
    file["skins"].push_back("x");
    CHECK(says(file) == "no error");
    for (const char* list : {"textures", "samplers", "images", "cameras", "materials", "meshes"}) {
        json none = json::parse(triangle_json());
        none[list] = list == std::string("meshes") ? none[list] : json(nullptr);
        INFO(list);
        CHECK(message_of([&] { (void)read_text(none.dump(), triangle_bytes()); }) == "no error");
    }
}

TEST_CASE("broken JSON is refused with line and column") {
    const auto message = [](const std::string& text) {
        return message_of([&] { (void)read_text(text, ""); });
    };
    CHECK(has(message("{\n \"asset\": nul\n}"), "broken at line 2, column"));
    CHECK(has(message("{\"asset\":{\"version\":\"2.0\"}} x"), "broken at line 1, column 29"));
    CHECK(has(message("{\"asset\":\"\xff\xfe\"}"), "invalid string"));
    CHECK(has(message("{\"a\":1e999}"), "number overflow"));
    CHECK(has(message(""), "broken at line 1"));
    CHECK(has(message("[1]"), "its JSON is no object"));
    const std::string control = message("{\"a\":\x1b[31m}");
    CHECK_FALSE(has(control, "\x1b"));
    CHECK(has(message("{\"asset\":{\"version\":\"2.0\",\"version\":\"1.0\"}}"),
              "the key 'version' stands twice in one object ('asset')"));
}

TEST_CASE("a mark of UTF-8 in front of the JSON is passed over") {
    CHECK(read_text("\xef\xbb\xbf" + triangle_json(), triangle_bytes()).report.triangles == 1);
}

TEST_CASE("values of JSON are bounded, and what nothing reads takes none of them") {
    mir::Limits limits;
    limits.json_values = 200;
    const json small = json::parse(triangle_json());
    CHECK(message_of([&] { (void)read_text(small.dump(), triangle_bytes(), limits); }) ==
          "no error");
    const json zeros = std::vector<int>(10'000, 0);
    const auto with_zeros = [&](const char* path) {
        json file = small;
        file[Pointer(path)] = zeros;
        mir::ErrorCode code = mir::ErrorCode::internal;
        std::string message =
            message_of([&] { (void)read_text(file.dump(), triangle_bytes(), limits); }, &code);
        if (message != "no error") CHECK(code == mir::ErrorCode::limit_exceeded);
        return message;
    };
    for (const char* path : {"/extras", "/nodes/0/extras", "/meshes/0/extras", "/VENDOR",
                             "/accessors/0/min", "/asset/extras", "/animations/0"})
        if (std::string(path) != "/animations/0") CHECK(with_zeros(path) == "no error");
    json animated = small;
    animated["animations"] = json::array({{{"channels", zeros}}});
    animated["materials"] = json::array({{{"extensions", {{"VENDOR", zeros}}}}});
    animated["scenes"][0]["extras"]["environment"] = zeros;
    const auto loaded = read_text(animated.dump(), triangle_bytes(), limits);
    CHECK(loaded.report.ignored.at("animation") == 1);
    CHECK(loaded.report.ignored.at("environment") == 1);
    CHECK(has(with_zeros("/nodes/0/weights"), "Limits::json_values allows 200"));
    json many = small;
    many["materials"] = std::vector<json>(50, json::object());
    CHECK(has(message_of([&] { (void)read_text(many.dump(), triangle_bytes(), limits); }),
              "Limits::json_values"));
}
