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

# For programs around the library whose own speed does not matter but whose templates are slow to compile: little
# optimisation, and these headers (or REUSE_FROM a target with the same options) compiled once.
function(vfit_quick_to_compile target)
  if(NOT MSVC)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  if(ARGV1 STREQUAL REUSE_FROM)
    target_precompile_headers(${target} REUSE_FROM ${ARGV2})
  else()
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# Several sources at once, so that their headers are read once.
function(vfit_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  # An unnamed namespace is then one of an included file, which GCC warns of.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

# The library's own sources too, unless somebody works on them.
function(vfit_together_in_the_library target)
  # These hold code for several SIMD targets, or the same names in several sources.
  set(apart vfit_math vfit_motion)
  if(VFIT_UNITY_BUILD AND NOT target IN_LIST apart)
    vfit_together(${target})
  endif()
endfunction()

# One room of sdk/ as a static library vfit_<room>: every .cpp in it. Further arguments: what it links.
function(vfit_add_room room)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/sdk/${room}/*.cpp)
  if(NOT sources)
    add_library(vfit_${room} INTERFACE)
    target_link_libraries(vfit_${room} INTERFACE ${ARGN})
    return()
  endif()
  add_library(vfit_${room} STATIC ${sources})
  target_include_directories(vfit_${room} PUBLIC ${CMAKE_SOURCE_DIR}/sdk ${CMAKE_SOURCE_DIR}/include)
  target_link_libraries(vfit_${room} PRIVATE vfit_settings PUBLIC ${ARGN})
  vfit_together_in_the_library(vfit_${room})
endfunction()

# A program of tests. Under sanitizers its own templates would take most of the time to compile: undefined behaviour is
# looked for in the code under test, and the tests are not optimised.
function(vfit_test_program target)
  if(VFIT_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  endif()
  if(VFIT_SANITIZE MATCHES undefined)
    target_compile_options(${target} PRIVATE -fno-sanitize=undefined)
  endif()
  target_compile_definitions(${target} PRIVATE VFIT_SOURCE_DIR="${CMAKE_SOURCE_DIR}" VFIT_DATA_DIR="${VFIT_DATA_DIR}"
    VFIT_PLUGIN_DIR="${CMAKE_BINARY_DIR}/lib/vfit_plugins")
  vfit_together(${target})
  if(target STREQUAL unit_core)
    vfit_quick_to_compile(${target} <gtest/gtest.h> <algorithm> <string> <vector>)
  else()
    vfit_quick_to_compile(${target} REUSE_FROM unit_core)
  endif()
endfunction()

# The unit tests of one room: every .cpp in tests/unit/<room>, as unit_<room>. Further arguments: what they link.
function(vfit_add_unit_test room)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/unit/${room}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(unit_${room} ${sources})
  target_include_directories(unit_${room} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_link_libraries(unit_${room} PRIVATE vfit_settings vfit_${room} ${ARGN} GTest::gtest_main)
  vfit_test_program(unit_${room})
  add_test(NAME unit_${room} COMMAND unit_${room})
  set_tests_properties(unit_${room} PROPERTIES LABELS unit)
endfunction()
