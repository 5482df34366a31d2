# Defines OpenCVParts::core, ::imgproc and ::imgcodecs. Debian's libopencv-{core,imgproc,imgcodecs}-dev hold the headers
# and libraries but no CMake package; that is only in libopencv-dev, which drags in 150 packages more.
find_path(OpenCVParts_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
set(needed OpenCVParts_INCLUDE_DIR)
foreach(part core imgproc imgcodecs)
  find_library(OpenCVParts_${part}_LIBRARY opencv_${part})
  list(APPEND needed OpenCVParts_${part}_LIBRARY)
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCVParts REQUIRED_VARS ${needed})

foreach(part core imgproc imgcodecs)
  if(OpenCVParts_FOUND AND NOT TARGET OpenCVParts::${part})
    add_library(OpenCVParts::${part} UNKNOWN IMPORTED)
    set_target_properties(OpenCVParts::${part} PROPERTIES
      IMPORTED_LOCATION ${OpenCVParts_${part}_LIBRARY}
      INTERFACE_INCLUDE_DIRECTORIES ${OpenCVParts_INCLUDE_DIR})
  endif()
endforeach()
