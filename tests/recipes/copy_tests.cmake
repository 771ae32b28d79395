# SPDX-License-Identifier: MIT
#
# tests/CMakeLists.txt of the copy that all patches are applied to: the tests that they add to or that
# ask about what they add, as one program.
include(MirTesting)

mir_add_test(test_recipes
    concepts/bsdf_test.cpp
    io/features_page_test.cpp
    io/gltf_writer_test.cpp
    io/mesh_features_test.cpp
    render/disc_light_test.cpp
    render/minnaert_test.cpp
    render/threads_backend_test.cpp
    sampling/first_hit_sampler_test.cpp
    scene/light_source_test.cpp
    sched/vpl_by_vpl_test.cpp
    LIBRARIES mir::runtime mir::io ${MIR_IO_PACKAGES} nlohmann_json::nlohmann_json)
target_compile_definitions(test_recipes PRIVATE
    MIR_DOCS_DIR="${PROJECT_SOURCE_DIR}/docs"
    MIR_SHARED_SCENES_DIR="${PROJECT_SOURCE_DIR}/shared/scenes")
