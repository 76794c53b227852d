# Puts the library, vfit_plugins, vfit_modules and vfit_data into the package folder. The library looks for
# the folders beside itself, the plug-ins for the library one folder up.
get_filename_component(vfit_library_dir "${VFIT_LIBRARY_FILE}" DIRECTORY)
foreach(folder IN ITEMS vfit_plugins vfit_modules vfit_data)
  if(NOT IS_DIRECTORY "${vfit_library_dir}/${folder}")
    message(FATAL_ERROR "${folder} is missing beside ${VFIT_LIBRARY_FILE}: build all of vfit first.")
  endif()
endforeach()

file(REAL_PATH "${VFIT_LIBRARY_FILE}" vfit_real_library)
get_filename_component(vfit_packaged_name "${VFIT_LIBRARY_FILE}" NAME)
if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
  find_program(PATCHELF patchelf REQUIRED)
  # A wheel holds no links: the file goes by the one name that the loader asks for.
  execute_process(COMMAND "${PATCHELF}" --print-soname "${vfit_real_library}"
    OUTPUT_VARIABLE vfit_packaged_name OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
endif()

install(FILES "${vfit_real_library}" DESTINATION . RENAME ${vfit_packaged_name})
install(DIRECTORY "${vfit_library_dir}/vfit_plugins" "${vfit_library_dir}/vfit_modules"
  "${vfit_library_dir}/vfit_data" DESTINATION . USE_SOURCE_PERMISSIONS)

if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
  # No path of the machine that built it stays in the package.
  install(CODE "
    file(GLOB plugins \"\${CMAKE_INSTALL_PREFIX}/vfit_plugins/*.so\")
    execute_process(COMMAND \"${PATCHELF}\" --set-rpath \\\$ORIGIN/.. \${plugins} COMMAND_ERROR_IS_FATAL ANY)
    execute_process(
      COMMAND \"${PATCHELF}\" --set-rpath \\\$ORIGIN \"\${CMAKE_INSTALL_PREFIX}/${vfit_packaged_name}\"
      COMMAND_ERROR_IS_FATAL ANY)")
endif()
