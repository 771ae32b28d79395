// SPDX-License-Identifier: MIT
#include "spectral_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace offline {

World::World(std::vector<Quad> quads)
    : quads_(std::move(quads)), device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_.get())) {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_QUAD);
    auto* corners = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), 4 * quads_.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                                4 * sizeof(std::uint32_t), quads_.size()));
    if (corners == nullptr || indices == nullptr) throw std::runtime_error("Embree has no memory");
    for (const Quad& q : quads_)
        for (const glm::vec3 corner : {q.p, q.p + q.a, q.p + q.a + q.b, q.p + q.b})
            *corners++ = corner;
    std::iota(indices, indices + 4 * quads_.size(), 0u);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_.get());
    if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE)
        throw std::runtime_error("Embree cannot prepare the scene");
}

bool World::closest(glm::vec3 origin, glm::vec3 direction, Point& out) const {
    RTCRayHit query{};
    query.ray.org_x = origin.x;
    query.ray.org_y = origin.y;
    query.ray.org_z = origin.z;
    query.ray.dir_x = direction.x;
    query.ray.dir_y = direction.y;
    query.ray.dir_z = direction.z;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if MIR_EMBREE_MAJOR == 4
    rtcIntersect1(scene_.get(), &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_.get(), &context, &query);
#endif
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    out.quad = &quads_[query.hit.primID];
    const glm::vec3 normal = glm::normalize(glm::cross(out.quad->a, out.quad->b));
    out.front = glm::dot(normal, direction) < 0.0f;
    out.normal = out.front ? normal : -normal;
    out.position = origin + query.ray.tfar * direction + offset * out.normal;
    return true;
}

namespace {

/// Uniform in [0, 1).
float next(std::mt19937& random) { return static_cast<float>(random() >> 8) * 0x1p-24f; }

/// Density cos / pi.
glm::vec3 diffuse_direction(glm::vec3 normal, std::mt19937& random) {
    const float z = 1.0f - 2.0f * next(random);
    const float phi = 2.0f * pi * next(random);
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    return glm::normalize(normal + 0.999999f * glm::vec3(r * std::cos(phi), r * std::sin(phi), z));
}

float mean(const Spectrum& s) {
    return std::accumulate(s.begin(), s.end(), 0.0f) / static_cast<float>(s.size());
}

float area(const Quad& q) { return glm::length(glm::cross(q.a, q.b)); }

/// Probability of each quad to be where a path starts: its share of the emitted power.
std::vector<float> start_probabilities(const World& world) {
    std::vector<float> p;
    for (const Quad& q : world.quads()) p.push_back(mean(q.radiance) * area(q));
    const float sum = std::accumulate(p.begin(), p.end(), 0.0f);
    for (float& x : p) x /= sum;
    return p;
}

std::size_t pick(const std::vector<float>& probabilities, float u) {
    std::size_t i = 0;
    while (i + 1 < probabilities.size() && u >= probabilities[i]) u -= probabilities[i++];
    return i;
}

Spectrum scaled(Spectrum s, float by) {
    for (float& x : s) x *= by;
    return s;
}

Spectrum product(const Spectrum& a, const Spectrum& b) {
    Spectrum c{};
    for (std::size_t i = 0; i < c.size(); ++i) c[i] = a[i] * b[i];
    return c;
}

/// Follows the light that leaves `from` in a diffuse way; `power` is what it stands for, W nm^-1.
void follow(const World& world, Point from, Spectrum power, std::mt19937& random,
            std::vector<Light>& lights) {
    glm::vec3 direction = diffuse_direction(from.normal, random);
    Point at;
    while (world.closest(from.position, direction, at)) {
        const Material& m = at.quad->material;
        const Spectrum reflected = product(power, m.reflectance);
        // All that is reflected, spread evenly: the lobe is lost to what the light shines at next.
        lights.push_back({at.position, at.normal, scaled(reflected, 1.0f / pi)});
        const float survival = *std::max_element(m.reflectance.begin(), m.reflectance.end());
        if (next(random) >= survival) return;
        const float cos_i = -glm::dot(direction, at.normal);
        direction = diffuse_direction(at.normal, random);
        const float lobe = lobe_factor(m.lobe, cos_i, glm::dot(direction, at.normal));
        power = scaled(reflected, lobe / survival);
        from = at;
    }
}

}  // namespace

std::vector<Light> trace_lights(const World& world, std::uint32_t paths, std::uint32_t seed) {
    std::mt19937 random(seed);
    const std::vector<float> probabilities = start_probabilities(world);
    std::vector<Light> lights;
    for (std::uint32_t i = 0; i < paths; ++i) {
        const std::size_t k = pick(probabilities, next(random));
        const Quad& q = world.quads()[k];
        Point start;
        start.quad = &q;
        start.normal = glm::normalize(glm::cross(q.a, q.b));
        const float u = next(random);
        start.position = q.p + u * q.a + next(random) * q.b + offset * start.normal;
        const float density = probabilities[k] / area(q) * static_cast<float>(paths);
        const Spectrum along_normal = scaled(q.radiance, 1.0f / density);
        lights.push_back({start.position, start.normal, along_normal});
        follow(world, start, scaled(along_normal, pi), random, lights);
    }
    return lights;
}

}  // namespace offline
