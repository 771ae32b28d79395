// SPDX-License-Identifier: MIT
#include "io/detail/outside.hpp"
#include "io/gltf_everything.hpp"
#include "support/catch.hpp"

#include <filesystem>
#include <string>

using namespace mirtest;
namespace fs = std::filesystem;

namespace {

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// A folder with a secret, and in it the folder of a scene.
class Folders {
 public:
    Folders() {
        fs::create_directory(top / "scene");
        fs::create_directory(top / "scene/sub");
        write_file(top / "secret.bin", triangle_bytes());
        write_file(top / "secret.png", small_png());
        write_file(top / "scene/data.bin", triangle_bytes());
        write_file(top / "scene/inside.png", small_png());
    }

    /// The triangle with this URI of its buffer.
    [[nodiscard]] mir::LoadedScene read_buffer(const std::string& uri, bool allow = false) const {
        write_file(top / "scene/scene.gltf", with(triangle_json(), "data.bin", uri));
        return read(allow);
    }

    [[nodiscard]] mir::LoadedScene read_image(const std::string& uri, bool allow = false) const {
        auto text = with(triangle_json(), R"("indices":1)", R"("indices":1,"material":0)");
        text = with(text, R"("scene":0)",
                    R"("scene":0,"textures":[{"source":0}],"images":[{"uri":")" + uri +
                        R"("}],"materials":[{"emissiveTexture":{"index":0}}])");
        write_file(top / "scene/scene.gltf", text);
        return read(allow);
    }

    TemporaryFolder top{"gltf_outside"};

 private:
    [[nodiscard]] mir::LoadedScene read(bool allow) const {
        mir::Limits limits;
        limits.allow_outside = allow;
        return mir::read_gltf(top / "scene/scene.gltf", limits);
    }
};

}  // namespace

TEST_CASE("a buffer outside of the scene's folder is refused unless that is allowed") {
    const Folders folders;
    fs::create_symlink(folders.top / "secret.bin", folders.top / "scene/link.bin");
    fs::create_directory_symlink(fs::path(".."), folders.top / "scene/up");
    for (const std::string& uri :
         {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"),
          std::string("..%2Fsecret.bin"), std::string("sub/../../secret.bin"),
          (folders.top / "secret.bin").string(), std::string("link.bin"),
          std::string("up/secret.bin"), std::string("./up/./secret.bin")}) {
        CAPTURE(uri);
        mir::ErrorCode code = mir::ErrorCode::internal;
        const std::string message = message_of([&] { (void)folders.read_buffer(uri); }, &code);
        INFO(message);
        CHECK(has(message, "buffer 0: its file"));
        CHECK(has(message, "lies outside of the scene's folder"));
        CHECK(has(message, "--allow-outside"));
        CHECK(code == mir::ErrorCode::invalid_input);
        // What the system makes of it.
        CHECK(folders.read_buffer(uri, true).report.triangles == 1);
    }
}

TEST_CASE("files below the scene's folder are read, also by links that stay in it") {
    const Folders folders;
    write_file(folders.top / "scene/sub/deep.bin", triangle_bytes());
    fs::create_symlink("sub/deep.bin", folders.top / "scene/near.bin");
    for (const char* uri : {"data.bin", "sub/deep.bin", "near.bin", "sub/../data.bin"}) {
        CAPTURE(uri);
        CHECK(folders.read_buffer(uri).report.triangles == 1);
    }
    // The scene itself may be reached by a link.
    fs::create_directory_symlink(folders.top / "scene", folders.top / "by_link");
    CHECK(mir::read_gltf(folders.top / "by_link/scene.gltf").report.triangles == 1);
}

TEST_CASE("a scene in the working folder needs no folder in its name") {
    const Folders folders;
    (void)folders.read_buffer("data.bin");
    CHECK_FALSE(mir::detail::leads_outside("", "data.bin"));
    CHECK(mir::detail::leads_outside("", "../data.bin"));
    CHECK(mir::detail::leads_outside("a", std::string("b\0c", 3)));
    CHECK(mir::detail::leads_outside("a", "C:\\b"));
    CHECK(mir::detail::leads_outside("a", "/b"));
    CHECK_FALSE(mir::detail::leads_outside("a", "..b"));
    CHECK_FALSE(mir::detail::leads_outside("no folder", "b"));
}

TEST_CASE("a buffer of another place than a file is refused by its scheme") {
    const Folders folders;
    for (const char* uri : {"http://localhost/data.bin", "https://localhost/data.bin",
                            "file:///etc/passwd", "FILE:data.bin", "ftp://x/y"})
        for (const bool allow : {false, true}) {
            const std::string message = message_of([&] { (void)folders.read_buffer(uri, allow); });
            INFO(message);
            CHECK(has(message, "buffer 0: its data are at '"));
            CHECK(has(message, "opens files beside the scene"));
        }
}

TEST_CASE("an image outside of the scene's folder counts as missing unless it is allowed") {
    const Folders folders;
    CHECK(folders.read_image("inside.png").scene.images.size() == 1);
    fs::create_symlink(folders.top / "secret.png", folders.top / "scene/link.png");
    for (const std::string& uri : {std::string("../secret.png"), std::string("link.png"),
                                   (folders.top / "secret.png").string()}) {
        const auto loaded = folders.read_image(uri);
        CAPTURE(uri);
        CHECK(loaded.scene.images.empty());
        CHECK(loaded.report.ignored.at("image outside of the scene's folder") == 1);
        CHECK(folders.read_image(uri, true).scene.images.size() == 1);
    }
    const auto far = folders.read_image("https://localhost/a.png", true);
    CHECK(far.report.ignored.at(
              "image 'https://localhost/a.png' (only files beside the scene are read)") == 1);
}
