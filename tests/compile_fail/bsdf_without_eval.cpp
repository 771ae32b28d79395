// expect: B::eval(p, n, wi, wo)
// SPDX-License-Identifier: MIT
#include "mir/concepts/archetypes.hpp"
#include "mir/shading/vpl_shading.hpp"

struct Model : mir::archetype::Bsdf {
#ifdef MIR_COMPILE_FAIL
    static void eval();
#endif
};

mir::Rgb shade(const mir::Hit& hit, const mir::VplShading<Model>::Surface& surface,
               const mir::Vpl& vpl) {
    return mir::VplShading<Model>{}(hit, surface, vpl);
}
