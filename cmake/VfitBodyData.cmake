# The parametric body: vfit_body_data runs scripts/bake_body.py into VFIT_DATA_DIR/body.bin. The source wheel
# and finished binaries are kept in VFIT_CACHE, so that a second build folder only copies.
if(DEFINED ENV{VFIT_CACHE})
  set(vfit_default_cache "$ENV{VFIT_CACHE}")
elseif(WIN32)
  set(vfit_default_cache "$ENV{LOCALAPPDATA}/vfit")
else()
  set(vfit_default_cache "$ENV{HOME}/.cache/vfit")
endif()
set(VFIT_CACHE "${vfit_default_cache}" CACHE PATH "Folder of downloaded and baked data")

# The interpreter that CMake prefers may be one without numpy; one that the user names comes first.
find_program(VFIT_BAKE_PYTHON NAMES python3 python
  HINTS ENV VIRTUAL_ENV PATH_SUFFIXES bin Scripts
  DOC "Python 3.9 or newer with numpy, for baking the body")
foreach(python IN ITEMS "${VFIT_BAKE_PYTHON}" "${Python3_EXECUTABLE}" /usr/bin/python3)
  execute_process(COMMAND "${python}" -c "import numpy"
    RESULT_VARIABLE vfit_no_numpy OUTPUT_QUIET ERROR_QUIET)
  if(vfit_no_numpy EQUAL 0)
    set(VFIT_BAKE_PYTHON "${python}" CACHE FILEPATH "" FORCE)
    break()
  endif()
endforeach()
if(NOT vfit_no_numpy EQUAL 0)
  message(FATAL_ERROR "No Python 3 with numpy found: install python3-numpy or set VFIT_BAKE_PYTHON")
endif()

set(vfit_body_binary ${CMAKE_BINARY_DIR}/lib/vfit_data/body.bin)
set(vfit_body_reference ${CMAKE_BINARY_DIR}/tests/body_reference.bin)  # exact points, for the unit test
set(vfit_body_scripts bake_body.py body_rig.py body_sections.py body_shapes.py makehuman_data.py)
list(TRANSFORM vfit_body_scripts PREPEND ${CMAKE_SOURCE_DIR}/scripts/)
add_custom_command(OUTPUT ${vfit_body_binary} ${vfit_body_reference}
  COMMAND "${VFIT_BAKE_PYTHON}" -B ${CMAKE_SOURCE_DIR}/scripts/bake_body.py --cache "${VFIT_CACHE}"
          --out ${vfit_body_binary} --reference ${vfit_body_reference}
  DEPENDS ${vfit_body_scripts}
  COMMENT "Baking the parametric body" VERBATIM)
add_custom_target(vfit_body_data ALL DEPENDS ${vfit_body_binary} ${vfit_body_reference})
# Whoever builds a single test or tool gets the data with it.
cmake_language(DEFER CALL add_dependencies vfit_body vfit_body_data)
