# Finds the vfit library to bind, as target vfit::vfit and file VFIT_LIBRARY_FILE:
#   1. VFIT_BUILD_DIR, a CMake or environment variable: a build folder of vfit
#   2. ../../build, where this folder lies in the source tree and that was built
#   3. an installed vfit (find_package)
set(VFIT_BUILD_DIR "" CACHE PATH "Build folder of vfit to take the library from")
if(NOT VFIT_BUILD_DIR)
  set(VFIT_BUILD_DIR "$ENV{VFIT_BUILD_DIR}")
endif()
get_filename_component(vfit_source_dir ${CMAKE_CURRENT_SOURCE_DIR}/../.. ABSOLUTE)

# Sets `out` to the library of a build folder, or to nothing.
function(vfit_library_in folder out)
  set(${out} "" PARENT_SCOPE)
  foreach(name IN ITEMS libvfit.so libvfit.dylib vfit.dll)
    foreach(place IN ITEMS lib bin)
      if(EXISTS "${folder}/${place}/${name}")
        set(${out} "${folder}/${place}/${name}" PARENT_SCOPE)
      endif()
    endforeach()
  endforeach()
endfunction()

if(VFIT_BUILD_DIR)
  get_filename_component(VFIT_BUILD_DIR "${VFIT_BUILD_DIR}" ABSOLUTE BASE_DIR ${vfit_source_dir})
  vfit_library_in("${VFIT_BUILD_DIR}" VFIT_LIBRARY_FILE)
  if(NOT VFIT_LIBRARY_FILE)
    message(FATAL_ERROR "VFIT_BUILD_DIR is ${VFIT_BUILD_DIR}, but no vfit library was built there.")
  endif()
elseif(EXISTS ${vfit_source_dir}/include/vfit.h)
  vfit_library_in(${vfit_source_dir}/build VFIT_LIBRARY_FILE)
endif()

if(VFIT_LIBRARY_FILE)
  if(NOT EXISTS ${vfit_source_dir}/include/vfit.h)
    message(FATAL_ERROR "VFIT_BUILD_DIR works inside the source tree of vfit only: vfit.h is not at "
                        "${vfit_source_dir}/include.")
  endif()
  add_library(vfit::vfit SHARED IMPORTED)
  set_target_properties(vfit::vfit PROPERTIES
    IMPORTED_LOCATION "${VFIT_LIBRARY_FILE}"
    INTERFACE_INCLUDE_DIRECTORIES ${vfit_source_dir}/include)
  if(WIN32)
    string(REGEX REPLACE "bin/vfit\\.dll$" "lib/vfit.lib" vfit_import_library "${VFIT_LIBRARY_FILE}")
    set_target_properties(vfit::vfit PROPERTIES IMPORTED_IMPLIB "${vfit_import_library}")
  endif()
else()
  find_package(vfit CONFIG QUIET)
  if(NOT vfit_FOUND)
    message(FATAL_ERROR
      "The vfit library is not built. Run the build first, in the root of the source tree:\n"
      "  cmake --preset release && cmake --build --preset release\n"
      "then pip install ./bindings/python again. A library elsewhere: set the environment variable "
      "VFIT_BUILD_DIR to its build folder, or CMAKE_PREFIX_PATH to where it is installed.")
  endif()
  foreach(configuration IN ITEMS "" _RELEASE _RELWITHDEBINFO _NOCONFIG _DEBUG)
    if(NOT VFIT_LIBRARY_FILE)
      get_target_property(VFIT_LIBRARY_FILE vfit::vfit IMPORTED_LOCATION${configuration})
    endif()
  endforeach()
endif()
message(STATUS "vfit library: ${VFIT_LIBRARY_FILE}")
