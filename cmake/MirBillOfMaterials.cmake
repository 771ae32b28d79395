# SPDX-License-Identifier: MIT
# The bill of materials, in SPDX 2.3 as JSON: this version of mir, its licence, and the packages that
# this build compiled in or links, each with the version that was found.
include(MirRelease)
set(MIR_BILL_OF_MATERIALS ${PROJECT_BINARY_DIR}/mir.spdx.json)

set(bill_packages "")
set(bill_relations "")

# mir_bill(NAME VERSION LICENCE [USER]): a package and who depends on it, mir unless told otherwise.
# A version that nobody knows is left out.
function(mir_bill name version licence)
    set(user mir)
    if(ARGC GREATER 3)
        set(user ${ARGV3})
    endif()
    set(line "")
    if(NOT version STREQUAL "")
        set(line "\n            \"versionInfo\": \"${version}\",")
    endif()
    set(bill_packages "${bill_packages},
        {
            \"SPDXID\": \"SPDXRef-${name}\",
            \"name\": \"${name}\",${line}
            \"downloadLocation\": \"NOASSERTION\",
            \"filesAnalyzed\": false,
            \"licenseConcluded\": \"${licence}\",
            \"licenseDeclared\": \"${licence}\",
            \"copyrightText\": \"NOASSERTION\"
        }" PARENT_SCOPE)
    set(bill_relations "${bill_relations},
        {
            \"spdxElementId\": \"SPDXRef-${user}\",
            \"relationshipType\": \"DEPENDS_ON\",
            \"relatedSpdxElement\": \"SPDXRef-${name}\"
        }" PARENT_SCOPE)
endfunction()

mir_bill(GLM "${glm_VERSION}" MIT)
if(MIR_WITH_CPU)
    mir_bill(oneTBB "${TBB_VERSION}" Apache-2.0)
endif()
if(TARGET mir_cpu)
    mir_bill(Embree "${MIR_EMBREE_VERSION}" Apache-2.0)
endif()
if(TARGET mir_cuda)
    mir_bill(CUDA-runtime "${CUDAToolkit_VERSION}" NOASSERTION)
endif()
if(MIR_WITH_IO)
    mir_bill(OpenEXR "${OpenEXR_VERSION}" BSD-3-Clause)
    mir_bill(Imath "${Imath_VERSION}" BSD-3-Clause OpenEXR)
    mir_bill(libpng "${PNG_VERSION_STRING}" libpng-2.0)
    mir_bill(zlib "${ZLIB_VERSION_STRING}" Zlib)
    mir_bill(tinygltf "${TinyGLTF_VERSION}" MIT)
    # Reads the pictures of glTF files; part of tinygltf, or a library of its own.
    mir_bill(stb-image "" MIT tinygltf)
    mir_bill(tinyobjloader "${tinyobjloader_VERSION}" MIT)
    mir_bill(nlohmann-json "${nlohmann_json_VERSION}" MIT)
endif()
if(TARGET mir_mpi)
    mir_bill(MPI "${MPI_CXX_VERSION}" NOASSERTION)
endif()
if(TARGET mir_tool)
    mir_bill(CLI11 "${MIR_CLI11_VERSION}" BSD-3-Clause)
endif()

file(STRINGS ${PROJECT_SOURCE_DIR}/LICENSE bill_copyright REGEX "^Copyright" LIMIT_COUNT 1)
# A name that no other document has: of its own content.
string(UUID bill_uuid NAMESPACE 6ba7b811-9dad-11d1-80b4-00c04fd430c8 TYPE SHA1
       NAME "mir ${PROJECT_VERSION} ${MIR_RELEASE_TIME} ${bill_packages}")
configure_file(${PROJECT_SOURCE_DIR}/cmake/mir.spdx.json.in ${MIR_BILL_OF_MATERIALS} @ONLY)
