# tinygltf is one header; its code is compiled here, hidden, into each library that uses it: ahead of all that
# those link. The distributions' libtinygltf exports it, and so does their libdraco, another version: in one
# process each would call into the other.
find_package(TinyGLTF REQUIRED)
set(vfit_tinygltf_source ${CMAKE_BINARY_DIR}/generated/tinygltf.cpp)
file(CONFIGURE OUTPUT ${vfit_tinygltf_source} CONTENT "#include <nlohmann/json.hpp>
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_INCLUDE_JSON
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>
")
add_library(vfit_tinygltf OBJECT ${vfit_tinygltf_source})
target_link_libraries(vfit_tinygltf PRIVATE nlohmann_json::nlohmann_json)
target_compile_features(vfit_tinygltf PRIVATE cxx_std_20)
get_target_property(vfit_tinygltf_include TinyGLTF::TinyGLTF INTERFACE_INCLUDE_DIRECTORIES)

if(vfit_tinygltf_include)
  target_include_directories(vfit_tinygltf SYSTEM PUBLIC ${vfit_tinygltf_include})
endif()

function(vfit_use_tinygltf target)
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:vfit_tinygltf>)
  target_include_directories(${target} SYSTEM PUBLIC ${vfit_tinygltf_include})
endfunction()
