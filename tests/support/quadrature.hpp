// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

#include <cmath>
#include <vector>

namespace mirtest {

inline constexpr double pi = 3.14159265358979323846;

/// int of f over [a, b]: Gauss-Legendre with four points in each of `pieces` equal pieces.
template <class F>
double integrate(double a, double b, int pieces, const F& f) {
    constexpr double node[2] = {0.33998104358485626, 0.86113631159405258};
    constexpr double weight[2] = {0.65214515486254614, 0.34785484513745386};
    const double half = 0.5 * (b - a) / pieces;
    double sum = 0.0;
    for (int i = 0; i < pieces; ++i) {
        const double middle = a + (2 * i + 1) * half;
        for (int k = 0; k < 2; ++k)
            sum += weight[k] * (f(middle - half * node[k]) + f(middle + half * node[k]));
    }
    return sum * half;
}

/// int of f(x, y) over the rectangle [ax, bx] x [ay, by], `pieces` along each side.
template <class F>
double integrate(double ax, double bx, double ay, double by, int pieces, const F& f) {
    return integrate(ax, bx, pieces, [&](double x) {
        return integrate(ay, by, pieces, [&](double y) { return f(x, y); });
    });
}

/// Integrals of `density` over the cells of an nx x ny grid on the unit square, row by row.
template <class F>
std::vector<double> cell_integrals(int nx, int ny, int pieces, const F& density) {
    std::vector<double> cells;
    for (int y = 0; y < ny; ++y)
        for (int x = 0; x < nx; ++x)
            cells.push_back(integrate(static_cast<double>(x) / nx, static_cast<double>(x + 1) / nx,
                                      static_cast<double>(y) / ny, static_cast<double>(y + 1) / ny,
                                      pieces, density));
    return cells;
}

/// Unit vector of the given cosine with +z and azimuth.
inline mir::Vec3 direction(double cosine, double phi) {
    const double sine = std::sqrt(std::fmax(0.0, 1.0 - cosine * cosine));
    return {static_cast<float>(sine * std::cos(phi)), static_cast<float>(sine * std::sin(phi)),
            static_cast<float>(cosine)};
}

/// int of f(unit vector) over the directions whose cosine with +z lies in [low, high].
template <class F>
double integrate_directions(double low, double high, int pieces, const F& f) {
    // By angle, not cosine: integrands with square roots of 1 - cosine stay smooth.
    return integrate(
        std::acos(high), std::acos(low), 0.0, 2 * pi, pieces, [&](double theta, double phi) {
            return std::sin(theta) * static_cast<double>(f(direction(std::cos(theta), phi)));
        });
}

/// int of f(unit vector) over the hemisphere around +z.
template <class F>
double integrate_hemisphere(int pieces, const F& f) {
    return integrate_directions(0.0, 1.0, pieces, f);
}

}  // namespace mirtest
