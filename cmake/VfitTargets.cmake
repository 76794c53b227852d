# Compiler settings that every target of the project shares.
add_library(vfit_settings INTERFACE)
target_compile_features(vfit_settings INTERFACE cxx_std_20 c_std_99)
if(MSVC)
  target_compile_options(vfit_settings INTERFACE /W4 /permissive-)
else()
  target_compile_options(vfit_settings INTERFACE -Wall -Wextra)
endif()
if(VFIT_SANITIZE)
  target_compile_options(vfit_settings INTERFACE -fsanitize=${VFIT_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(vfit_settings INTERFACE -fsanitize=${VFIT_SANITIZE})
endif()
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

# For programs around the library whose own speed does not matter but whose templates are slow to compile:
# little optimisation, and these headers (or REUSE_FROM a target with the same options) compiled once.
function(vfit_precompiled_headers target)
  if(NOT MSVC)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  if(ARGV1 STREQUAL REUSE_FROM)
    target_precompile_headers(${target} REUSE_FROM ${ARGV2})
  else()
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# With VFIT_UNITY_BUILD, several sources of the target in one translation unit, so that their headers are read
# once. The option is for speed alone: sources need not avoid each other's names in unnamed namespaces, and
# those that clash are listed here or marked SKIP_UNITY_BUILD_INCLUSION.
function(vfit_unity_build target)
  set(without vfit_math vfit_motion)  # code for several SIMD targets, or the same names in several sources
  if(NOT VFIT_UNITY_BUILD OR target IN_LIST without)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  # An unnamed namespace is then one of an included file, which GCC warns of.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

# One module of sdk/ as a static library vfit_<module>: every .cpp in it. Further arguments: what it links.
function(vfit_add_module module)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/sdk/${module}/*.cpp)
  if(NOT sources)
    add_library(vfit_${module} INTERFACE)
    target_link_libraries(vfit_${module} INTERFACE ${ARGN})
    return()
  endif()
  add_library(vfit_${module} STATIC ${sources})
  target_include_directories(vfit_${module} PUBLIC ${CMAKE_SOURCE_DIR}/sdk ${CMAKE_SOURCE_DIR}/include)
  target_link_libraries(vfit_${module} PRIVATE vfit_settings PUBLIC ${ARGN})
  vfit_unity_build(vfit_${module})
  if(VFIT_SANITIZE AND NOT module STREQUAL core)
    # Only here: the release build finds a missing include.
    target_precompile_headers(vfit_${module} PRIVATE <algorithm> <cmath> <glm/glm.hpp>
      <glm/gtc/quaternion.hpp> <memory> <optional> <span> <string> <vector>)
  endif()
endfunction()

# A program of tests. Under sanitizers its own templates would take most of the time to compile: undefined
# behaviour is looked for in the code under test, and the tests are not optimised.
function(vfit_test_program target)
  if(VFIT_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  endif()
  if(VFIT_SANITIZE MATCHES undefined)
    target_compile_options(${target} PRIVATE -fno-sanitize=undefined)
  endif()
  if(VFIT_SANITIZE MATCHES address)
    target_sources(${target} PRIVATE ${CMAKE_SOURCE_DIR}/tests/support/leak_check.cpp)
  endif()
  target_compile_definitions(${target} PRIVATE VFIT_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
    VFIT_DATA_DIR="${VFIT_DATA_DIR}" VFIT_PLUGIN_DIR="${CMAKE_BINARY_DIR}/lib/vfit_plugins")
  vfit_unity_build(${target})
  if(target STREQUAL unit_core)
    vfit_precompiled_headers(${target} <gtest/gtest.h> <algorithm> <string> <vector>)
  else()
    vfit_precompiled_headers(${target} REUSE_FROM unit_core)
  endif()
endfunction()

# The unit tests of one module: every .cpp in tests/unit/<module>, as unit_<module>. Further arguments: what
# they link.
function(vfit_add_unit_test module)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/unit/${module}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(unit_${module} ${sources})
  target_include_directories(unit_${module} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_link_libraries(unit_${module} PRIVATE vfit_settings vfit_${module} ${ARGN} GTest::gtest_main)
  vfit_test_program(unit_${module})
  add_test(NAME unit_${module} COMMAND unit_${module})
  set_tests_properties(unit_${module} PROPERTIES LABELS unit)
endfunction()
