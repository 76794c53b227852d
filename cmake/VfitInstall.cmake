# Install and export: find_package(vfit) and pkg-config. Plug-ins and data stand beside the library, where it
# looks for them.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS vfit EXPORT vfitTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES include/vfit.h include/vfit_plugin.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
foreach(plugin recording virtual_person openni2)
  if(TARGET vfit_plugin_${plugin})
    set_target_properties(vfit_plugin_${plugin} PROPERTIES INSTALL_RPATH "$ORIGIN/..")
    install(TARGETS vfit_plugin_${plugin} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/vfit_plugins)
  endif()
endforeach()
if(TARGET vfit_openni2_reader)
  install(TARGETS vfit_openni2_reader RUNTIME DESTINATION ${CMAKE_INSTALL_LIBDIR}/vfit_plugins)
endif()
install(TARGETS vfit_joint_network LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/vfit_modules)
install(DIRECTORY ${VFIT_DATA_DIR}/ DESTINATION ${CMAKE_INSTALL_LIBDIR}/vfit_data)
if(TARGET vfit_cli)
  set_target_properties(vfit_cli PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  install(TARGETS vfit_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(vfit_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/vfit)
install(EXPORT vfitTargets NAMESPACE vfit:: DESTINATION ${vfit_cmake_dir})
configure_package_config_file(cmake/vfitConfig.cmake.in ${CMAKE_BINARY_DIR}/vfitConfig.cmake
  INSTALL_DESTINATION ${vfit_cmake_dir})
# Within 0.x a minor version may break.
write_basic_package_version_file(${CMAKE_BINARY_DIR}/vfitConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/vfitConfig.cmake ${CMAKE_BINARY_DIR}/vfitConfigVersion.cmake
  DESTINATION ${vfit_cmake_dir})

# By its own place, so that cmake --install --prefix and a moved folder work.
file(RELATIVE_PATH vfit_pc_to_prefix "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
configure_file(cmake/vfit.pc.in ${CMAKE_BINARY_DIR}/vfit.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/vfit.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
