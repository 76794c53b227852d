# opencv_core, opencv_imgproc and opencv_dnn as targets. Debian ships OpenCVConfig.cmake only in libopencv-dev
# (963 MB), so where it is absent the libraries are found one by one.
find_package(OpenCV 4 QUIET COMPONENTS core imgproc dnn)
if(NOT OpenCV_FOUND)
  find_path(VFIT_OPENCV_INCLUDE opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
  foreach(part core imgproc dnn)
    find_library(VFIT_OPENCV_${part} opencv_${part} REQUIRED)
    add_library(opencv_${part} UNKNOWN IMPORTED GLOBAL)
    set_target_properties(opencv_${part} PROPERTIES IMPORTED_LOCATION ${VFIT_OPENCV_${part}}
      INTERFACE_INCLUDE_DIRECTORIES ${VFIT_OPENCV_INCLUDE})
  endforeach()
  target_link_libraries(opencv_imgproc INTERFACE opencv_core)
  target_link_libraries(opencv_dnn INTERFACE opencv_core)
endif()
