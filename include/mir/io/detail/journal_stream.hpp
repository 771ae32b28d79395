// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/byte_hash.hpp"
#include "mir/data/image.hpp"
#include "mir/runtime/result.hpp"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

namespace mir::detail {

/// Takes apart what is no plain value. `Stream` reads or writes bytes() and resizes with sized();
/// it may have an image() of its own. Bytes are those of memory, so files are good on machines of
/// one kind.
template <class Stream>
class Transfer {
 public:
    template <class... T>
    void operator()(T&... values) {
        (one(values), ...);
    }
    template <class I>
    void image(I& image) {
        const std::uint64_t width = self().sized(image.width(), 0);
        const std::uint64_t bytes_of_row = width * sizeof(image.pixels()[0]);
        const std::uint64_t height = self().sized(image.height(), bytes_of_row);
        if constexpr (!std::is_const_v<I>)
            image = I::unwritten(
                {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)});
        self().bytes(image.pixels().data(), image.pixels().size_bytes());
    }

 private:
    Stream& self() { return static_cast<Stream&>(*this); }

    template <class T>
    void one(T& value) {
        using Value = std::remove_const_t<T>;
        if constexpr (std::is_trivially_copyable_v<Value>)
            self().bytes(&value, sizeof value);
        else if constexpr (std::is_same_v<Value, RenderStatistics>)
            statistics(value);
        else if constexpr (std::is_same_v<Value, std::string>)
            text(value);
        else if constexpr (requires { value.extent(); })
            self().image(value);
        else if constexpr (requires { value.size(); })
            each(value);
        else
            Value::transfer(value, self());
    }
    template <class V>
    void each(V& values) {
        const std::uint64_t size = self().sized(values.size(), 1);
        for (std::uint64_t i = 0; i < size; ++i) {
            if constexpr (!std::is_const_v<V>)
                if (i == values.size()) values.emplace_back();
            one(values[i]);
        }
        // Sentences replace others. Images stay, because only rows of them may be read.
        if constexpr (!std::is_const_v<V> && std::is_same_v<typename V::value_type, std::string>)
            values.resize(size);
    }
    template <class S>
    void text(S& text) {
        const std::uint64_t size = self().sized(text.size(), 1);
        if constexpr (!std::is_const_v<S>) text.resize(size);
        self().bytes(text.data(), size);
    }
    template <class S>
    void statistics(S& s) {
        auto& [triangles, dropped_triangles, coinciding_triangles, luxels, luxel_rows_per_pixel,
               light_paths, camera_paths, vpls, surfels, patches, contributions, emitted_power,
               non_lambertian_share, widened_share, states, path_luminance, dropped_share, health,
               light_path_luminance, normalisation, bound, indirect_luminance, removed_luminance,
               vsl_radius, residual_paths, residual_luminance, caustic_paths, caustic_luminance,
               caustic_direct_luminance, direct_error, residual_error, caustic_error,
               faint_caustics, removed, cut, direct_noise, gather_difference, gather_corrected,
               backend, device, acceleration, scheduler, scene_hash, origin, seconds, passes,
               relative_error, complete] = s;
        (*this)(triangles, dropped_triangles, coinciding_triangles, luxels, luxel_rows_per_pixel,
                light_paths, camera_paths, vpls, surfels, patches, contributions, emitted_power,
                non_lambertian_share, widened_share, states, path_luminance, dropped_share, health,
                light_path_luminance, normalisation, bound, indirect_luminance, removed_luminance,
                vsl_radius, residual_paths, residual_luminance, caustic_paths, caustic_luminance,
                caustic_direct_luminance, direct_error, residual_error, caustic_error,
                faint_caustics, removed, cut, direct_noise, gather_difference, gather_corrected,
                backend, device, acceleration, scheduler, scene_hash, origin, seconds, passes,
                relative_error, complete);
    }
};

/// Writes values, and keeps the hash of what it wrote.
class JournalWriter : public Transfer<JournalWriter> {
 public:
    explicit JournalWriter(std::ostream& stream) : stream_(stream) {}

    void bytes(const void* data, std::size_t size) {
        hash_.add(data, size);
        stream_.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    }
    std::uint64_t sized(std::uint64_t size, std::uint64_t /*bytes_each*/) {
        bytes(&size, sizeof size);
        return size;
    }
    [[nodiscard]] std::uint64_t hash() const { return hash_.value(); }

 private:
    std::ostream& stream_;
    ByteHash hash_;
};

/// What a journal cannot be.
struct BrokenJournal {};

/// Reads values, and keeps the hash of what it read. Never takes more memory than the file is long.
class JournalReader : public Transfer<JournalReader> {
 public:
    /// `left`: bytes of the file from here on.
    JournalReader(std::istream& stream, std::uint64_t left) : stream_(stream), left_(left) {}

    /// @throws BrokenJournal when the file has no so many bytes left.
    void bytes(void* data, std::size_t size) {
        if (size > left_) throw BrokenJournal{};
        left_ -= size;
        stream_.read(static_cast<char*>(data), static_cast<std::streamsize>(size));
        if (!stream_) throw BrokenJournal{};
        hash_.add(data, size);
    }
    /// Reads how many things of at least `bytes_each` bytes follow.
    /// @throws BrokenJournal when the file is too short for them.
    std::uint64_t sized(std::uint64_t /*size*/, std::uint64_t bytes_each) {
        std::uint64_t size = 0;
        bytes(&size, sizeof size);
        if (size > left_ || (bytes_each > 0 && size > left_ / bytes_each)) throw BrokenJournal{};
        return size;
    }
    [[nodiscard]] std::uint64_t hash() const { return hash_.value(); }
    [[nodiscard]] std::uint64_t left() const { return left_; }

 private:
    std::istream& stream_;
    std::uint64_t left_;
    ByteHash hash_;
};

}  // namespace mir::detail
