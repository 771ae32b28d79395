// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/reference/path_tracer.hpp"
#include "mir/reference/reference_image.hpp"

#include <optional>

namespace mir {

/// Where the camera rays of a reference image go through the film.
enum class FilmPosition {
    luxel,  ///< the ray of the luxel, every time: what other estimators see at that luxel
    pixel   ///< anywhere in the pixel that holds the luxel, and on the lens: a box filter
};

/// Rows of luxels from the top.
struct LuxelRows {
    std::uint32_t first = 0;             ///< of the whole image
    std::optional<std::uint32_t> count;  ///< up to the last row unless given
};

/// How much to trace. Memory is 48 bytes per luxel and layer, the beauty's layer included.
struct ReferenceOptions {
    std::uint32_t samples = 64;               ///< estimates per luxel and replicate
    std::uint32_t replicates = 16;            ///< independent images
    std::uint32_t first_replicate = 0;        ///< number of the first: names its random numbers
    FilmPosition film = FilmPosition::luxel;  ///< where camera rays go through
    std::uint8_t last_bounce = 8;             ///< last bounce with a layer of its own
    LuxelRows rows{};                         ///< to trace: the image holds these alone
};

namespace detail {

/// Ray through a random place of the pixel that holds luxel (x, y).
inline Ray ray_in_pixel(const CameraRays& rays, std::uint32_t x, std::uint32_t y, Random& random) {
    const auto width = static_cast<float>(rays.grid.pixels.width);
    const auto height = static_cast<float>(rays.grid.pixels.height);
    const Vec2 corner(x / rays.grid.per_pixel_x, y / rays.grid.per_pixel_y);
    const Vec2 film = (corner + random.next_2d()) / Vec2(width, height);
    return rays.camera.ray(film, width / height, random.next_2d());
}

/// Rows of one reference image.
template <class Tracer>
class ReferenceRows {
 public:
    ReferenceRows(const Tracer& tracer, const CameraRays& rays, const ReferenceOptions& options,
                  ReferenceImage& image)
        : tracer_(tracer), rays_(rays), options_(options), image_(image) {}

    /// Row `row` of the image.
    void operator()(std::uint32_t row) const {
        const std::uint32_t y = options_.rows.first + row;
        // Bounces without a layer share the last element.
        std::vector<RgbSum> bounces(std::size_t{image_.last_bounce()} + 2);
        for (std::uint32_t x = 0; x < image_.extent().width; ++x) {
            const Ray ray = rays_(x, y);
            const auto luxel = tracer_.luxel(ray);
            const bool is_drawn = tracer_.is_drawn(ray);
            for (std::uint32_t r = 0; r < options_.replicates; ++r) {
                for (RgbSum& b : bounces) b = {};
                for (std::uint32_t s = 0; s < options_.samples; ++s)
                    add_sample(ray, luxel, {x, y, r, s, is_drawn}, bounces);
                for (RgbSum& b : bounces) b = b * (1.0 / options_.samples);
                image_.add(x, row, r, bounces);
            }
        }
    }

 private:
    /// A sample of a luxel.
    struct Sample {
        std::uint32_t x;
        std::uint32_t y;
        std::uint32_t replicate;
        std::uint32_t number;
        bool draws_chain;  ///< the luxel's ray may end in several places
    };

    /// `ray` is that of the luxel, which is `seen`.
    void add_sample(const Ray& ray, const typename Tracer::Vertex& seen, Sample at,
                    std::span<RgbSum> bounces) const {
        const std::uint64_t round =
            (std::uint64_t{options_.first_replicate} + at.replicate) * options_.samples + at.number;
        const Extent whole = rays_.grid.luxels();
        const std::uint64_t luxel = std::uint64_t{at.y} * whole.width + at.x;
        Random random(rays_.seed, Stream::reference, round * whole.area() + luxel);
        if (options_.film == FilmPosition::pixel)
            return tracer_.trace(tracer_.luxel(ray_in_pixel(rays_, at.x, at.y, random)), random,
                                 bounces);
        if (!at.draws_chain) return tracer_.trace(seen, random, bounces);
        const float stratum = static_cast<float>(at.number) + random.next();
        const float first = stratum / static_cast<float>(options_.samples);
        tracer_.trace(tracer_.luxel(ray, {smaller(first, 0x1.fffffep-1f), 0.0f}), random, bounces);
    }

    const Tracer& tracer_;
    const CameraRays& rays_;
    const ReferenceOptions& options_;
    ReferenceImage& image_;
};

}  // namespace detail

/// Traces the image of all luxels of `rays`, in parallel over rows. Replicate r of one seed has
/// the same numbers in every call, on any machine and any number of threads, and shares none with
/// another replicate or another stream: single replicates, and a reference that goes on where
/// another ended, are had through `first_replicate`. Rows have the numbers that they have in the
/// whole image.
/// @throws Error(invalid_argument) when options are out of range, and what the executor throws.
template <class Tracer, Executor E>
ReferenceImage trace_reference(const Tracer& tracer, const CameraRays& rays,
                               const ReferenceOptions& options, E& executor) {
    expects(options.samples >= 1 && options.replicates >= 1,
            "a reference of no samples was asked for (there would be no image); ask for at least "
            "one sample and one replicate");
    const Extent whole = rays.grid.luxels();
    expects(options.rows.first < whole.height &&
                options.rows.count.value_or(1) <= whole.height - options.rows.first,
            "rows of a reference lie below the image; ask for rows that it has");
    ReferenceImage image(
        {whole.width, options.rows.count.value_or(whole.height - options.rows.first)},
        std::min(options.last_bounce, tracer.options().max_bounce.value_or(options.last_bounce)),
        options.replicates);
    const detail::ReferenceRows<Tracer> row(tracer, rays, options, image);
    executor.for_each(image.extent().height,
                      [&](std::size_t y) { row(static_cast<std::uint32_t>(y)); });
    return image;
}

}  // namespace mir
