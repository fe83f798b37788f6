# What the project needs from outside; every package is one of Debian's and Ubuntu's.
find_package(Threads REQUIRED)
find_package(Highway REQUIRED)
find_package(TBB CONFIG REQUIRED)
find_package(Eigen3 CONFIG REQUIRED)

if(CAROM_BUILD_PROGRAM OR CAROM_BUILD_TESTS OR CAROM_BUILD_BENCH OR CAROM_BUILD_PEERS OR CAROM_FUZZ)
  # Debian's libzip-config.cmake refers to programs of other packages, so pkg-config it is.
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(libzip REQUIRED IMPORTED_TARGET libzip)
  find_package(CLI11 CONFIG REQUIRED)
  find_package(nlohmann_json CONFIG REQUIRED)
endif()
if(CAROM_BUILD_TESTS)
  find_package(GTest CONFIG REQUIRED)
  find_package(rapidcheck CONFIG REQUIRED)
  find_package(Boost REQUIRED)
endif()
if(CAROM_BUILD_BENCH OR CAROM_BUILD_PEERS)
  find_package(benchmark CONFIG REQUIRED)
endif()
if(CAROM_BUILD_PEERS)
  find_path(CGAL_INCLUDE_DIR CGAL/box_intersection_d.h REQUIRED)  # header only, as used here
  pkg_check_modules(bullet REQUIRED IMPORTED_TARGET bullet)
  pkg_check_modules(ode REQUIRED IMPORTED_TARGET ode)
  # Both package files of FCL ask for more than its broadphase needs, and for C++11.
  pkg_check_modules(fcl REQUIRED fcl)
  find_library(FCL_LIBRARY fcl REQUIRED)
endif()
