// SPDX-License-Identifier: MIT
#pragma once

#include "io/gltf_fixture.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace mirtest {

/// A good file that has every property that the reader uses, and some that it does not.
inline nlohmann::json everything_json() {
    return nlohmann::json::parse(R"({
"asset":{"version":"2.0","minVersion":"2.0","generator":"g","copyright":"c"},
"extensionsUsed":["KHR_lights_punctual"],"extensionsRequired":["KHR_lights_punctual"],
"scene":1,
"scenes":[{"nodes":[]},{"name":"s","nodes":[0,4],"extras":{"note":1}}],
"extensions":{"KHR_lights_punctual":{"lights":[
 {"name":"spot","type":"spot","color":[1,0.5,0.25],"intensity":2,"range":0,
  "spot":{"innerConeAngle":0.1,"outerConeAngle":0.5},"extras":{"light_group":2}}]}},
"nodes":[
 {"name":"root","translation":[1,2,3],"rotation":[0,0,0,1],"scale":[1,2,1],"children":[1,2,3]},
 {"name":"copies","mesh":0,"weights":[0.5],
  "extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}},
 {"name":"lens","camera":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,5,1]},
 {"name":"lamp","extensions":{"KHR_lights_punctual":{"light":0}}},
 {"name":"bent","mesh":1,"skin":0}],
"meshes":[
 {"name":"m","weights":[0.25],"primitives":[{"attributes":{"POSITION":0,"NORMAL":6,"TEXCOORD_0":2,
  "COLOR_0":3,"TANGENT":0},"indices":1,"material":0,"mode":4,"targets":[{"POSITION":5}]}]},
 {"name":"n","primitives":[{"attributes":{"POSITION":4,"JOINTS_0":7,"WEIGHTS_0":8},"indices":1,
  "material":1}]}],
"skins":[{"joints":[0]}],
"materials":[
 {"name":"a","doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.25,"emissiveFactor":[1,0,0],
  "pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1],"metallicFactor":0.5,"roughnessFactor":0.5,
   "baseColorTexture":{"index":0,"texCoord":0,"extensions":{"KHR_texture_transform":
    {"offset":[0,0],"scale":[2,2],"rotation":0.5,"texCoord":0}}},
   "metallicRoughnessTexture":{"index":0}},
  "normalTexture":{"index":0,"scale":0.5},"emissiveTexture":{"index":1},
  "occlusionTexture":{"index":0,"strength":0.5},
  "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":3},
   "KHR_materials_ior":{"ior":1.4},
   "KHR_materials_specular":{"specularFactor":0.5,"specularColorFactor":[1,1,1]}},
  "extras":{"light_group":1,"other":[1,2,3]}},
 {"name":"b","extensions":{"KHR_materials_pbrSpecularGlossiness":
  {"diffuseFactor":[1,0,0,1],"glossinessFactor":0.5},"KHR_materials_sheen":{"x":[1]}}}],
"textures":[{"name":"t","sampler":0,"source":0},{"source":1}],
"samplers":[{"name":"s","magFilter":9728,"minFilter":9728,"wrapS":33071,"wrapT":33648}],
"images":[{"name":"i","bufferView":9,"mimeType":"image/png"},{"uri":"no such.png"}],
"cameras":[{"name":"c","type":"perspective","perspective":
 {"yfov":0.8,"aspectRatio":1.5,"znear":0.1,"zfar":100},
 "extras":{"lens_radius":0.25,"focus_distance":2,"resolution":[3,2]}}],
"accessors":[
 {"name":"p","bufferView":0,"byteOffset":0,"componentType":5126,"count":3,"type":"VEC3",
  "min":[0,0,0],"max":[1,1,0]},
 {"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"},
 {"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"},
 {"bufferView":3,"componentType":5123,"normalized":true,"count":3,"type":"VEC4"},
 {"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,
  "indices":{"bufferView":4,"byteOffset":0,"componentType":5121},
  "values":{"bufferView":5,"byteOffset":0}}},
 {"bufferView":6,"componentType":5126,"count":3,"type":"VEC3"},
 {"bufferView":6,"componentType":5126,"count":3,"type":"VEC3"},
 {"bufferView":7,"componentType":5121,"count":3,"type":"VEC4"},
 {"bufferView":8,"componentType":5126,"count":3,"type":"VEC4"}],
"bufferViews":[
 {"name":"v","buffer":0,"byteOffset":0,"byteLength":36,"byteStride":12,"target":34962},
 {"buffer":0,"byteOffset":36,"byteLength":4},
 {"buffer":0,"byteOffset":40,"byteLength":24},
 {"buffer":0,"byteOffset":64,"byteLength":24},
 {"buffer":0,"byteOffset":88,"byteLength":4},
 {"buffer":0,"byteOffset":92,"byteLength":12},
 {"buffer":0,"byteOffset":104,"byteLength":36},
 {"buffer":0,"byteOffset":140,"byteLength":12},
 {"buffer":0,"byteOffset":152,"byteLength":48},
 {"buffer":0,"byteOffset":200,"byteLength":70}],
"buffers":[{"name":"d","byteLength":270,"uri":"data.bin"}],
"animations":[{"channels":[{"sampler":0,"target":{"path":"translation"}}],
 "samplers":[{"input":99,"output":"x"}]}],
"extras":{"whatever":[null]}
})");
}

/// One grey pixel.
inline std::string small_png() {
    static const unsigned char bytes[] = {
        0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
        0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06, 0x00, 0x00,
        0x00, 0x1f, 0x15, 0xc4, 0x89, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x44, 0x41, 0x54, 0x78,
        0xda, 0x63, 0x68, 0x68, 0x68, 0xf8, 0x0f, 0x00, 0x05, 0x84, 0x02, 0x80, 0x53, 0x93,
        0x74, 0x36, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    return {reinterpret_cast<const char*>(bytes), sizeof bytes};
}

inline std::string everything_bytes() {
    return triangle_bytes() + bytes_of<float>({0, 0, 1, 0, 0, 1}) +
           bytes_of<std::uint16_t>({65535, 0, 0, 65535, 65535, 0, 0, 65535, 65535, 0, 0, 65535}) +
           bytes_of<std::uint8_t>({2, 0, 0, 0}) + bytes_of<float>({0, 2, 0}) +
           bytes_of<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}) + std::string(12, '\0') +
           bytes_of<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}) + small_png();
}

}  // namespace mirtest
