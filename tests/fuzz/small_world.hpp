// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/worlds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace mirfuzz {

/// Reads numbers from the bytes of a fuzzer; zeros when there are no more.
class ByteReader {
 public:
    ByteReader(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

    template <class T>
    T next() {
        T value{};
        const std::size_t size = std::min(sizeof(T), left_);
        std::memcpy(&value, data_, size);
        data_ += size;
        left_ -= size;
        return value;
    }
    [[nodiscard]] bool empty() const { return left_ == 0; }

 private:
    const std::uint8_t* data_;
    std::size_t left_;
};

/// How coordinates are made of bytes.
class Coordinates {
 public:
    /// Two bytes choose a kind and a scale.
    explicit Coordinates(ByteReader& bytes) : bytes_(bytes) {
        kind_ = bytes.next<std::uint8_t>() % 4;
        scale_ = std::ldexp(1.0f, bytes.next<std::int8_t>() / 4);
    }

    mir::Vec3 next() {
        const float x = number();
        const float y = number();
        return {x, y, number()};
    }

 private:
    /// On a grid, where much is degenerate; a few units in the last place beside it; far from the
    /// origin; or any bits that are a number between 2^-40 and 2^40 in size.
    float number() {
        if (kind_ == 3) return any();
        float x = scale_ * static_cast<float>(bytes_.next<std::int8_t>());
        if (kind_ == 1)
            for (int i = bytes_.next<std::uint8_t>() % 4; i > 0; --i)
                x = std::nextafter(x, 2.0f * x);
        return kind_ == 2 ? x + 256.0f * scale_ * static_cast<float>(bytes_.next<std::int16_t>())
                          : x;
    }
    float any() {
        const auto x = bytes_.next<float>();
        const float size = std::fabs(x);
        return size >= 0x1p-40f && size <= 0x1p40f ? x : 0.0f;
    }

    ByteReader& bytes_;
    unsigned int kind_ = 0;
    float scale_ = 1.0f;
};

/// Up to 24 corners and 32 triangles over them.
inline mir::Scene small_scene(ByteReader& bytes, Coordinates& coordinates) {
    mir::Mesh mesh;
    const std::size_t corners = 3 + bytes.next<std::uint8_t>() % 22;
    const std::size_t triangles = 1 + bytes.next<std::uint8_t>() % 32;
    for (std::size_t i = 0; i < corners; ++i) mesh.positions.push_back(coordinates.next());
    const auto corner = [&] {
        return static_cast<std::uint32_t>(bytes.next<std::uint8_t>() % corners);
    };
    for (std::size_t i = 0; i < triangles; ++i) {
        const std::uint32_t a = corner();
        const std::uint32_t b = corner();
        mesh.triangles.push_back({a, b, corner()});
    }
    mir::Scene scene;
    mesh.material = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(std::move(mesh));
    return scene;
}

/// An end of a segment: a corner, a point between two corners, or anywhere.
inline mir::Vec3 some_place(ByteReader& bytes, Coordinates& coordinates,
                            const mir::WorldGeometry& geometry) {
    const auto all = geometry.positions();
    const auto corner = [&] { return all[bytes.next<std::uint8_t>() % all.size()]; };
    const unsigned int kind = bytes.next<std::uint8_t>() % 4;
    if (kind == 0) return coordinates.next();
    const mir::Vec3 a = corner();
    if (kind == 1) return a;
    const float way = static_cast<float>(bytes.next<std::uint8_t>()) / 64.0f;
    return a + way * (corner() - a);
}

}  // namespace mirfuzz
