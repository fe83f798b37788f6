# Google Highway as the target hwy::hwy, from its CMake package or from pkg-config.
# Installed beside the package configuration of carom, which needs it for the static library.
find_package(hwy CONFIG QUIET)
if(TARGET hwy::hwy)
  set(Highway_VERSION ${hwy_VERSION})
else()
  find_package(PkgConfig QUIET)
  if(PkgConfig_FOUND)
    pkg_check_modules(libhwy QUIET IMPORTED_TARGET GLOBAL libhwy)
  endif()
  if(TARGET PkgConfig::libhwy)
    set(Highway_VERSION ${libhwy_VERSION})
    add_library(hwy::hwy ALIAS PkgConfig::libhwy)
  endif()
endif()

if(TARGET hwy::hwy)
  set(Highway_TARGET hwy::hwy)
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Highway REQUIRED_VARS Highway_TARGET
                                  VERSION_VAR Highway_VERSION)
