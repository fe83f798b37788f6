# The target carom_build_info: the header "carom_build_info.h" with compiler, flags, commit and
# library versions. It is looked at in every build and written only when something changed.
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type_upper)
list(JOIN CAROM_MATH_FLAGS " " math_flags)
list(JOIN CAROM_COPY_FLAGS " " copy_flags)
set(build_info_flags
    "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type_upper}} ${math_flags} ${copy_flags}")
if(CAROM_SANITIZE)
  string(APPEND build_info_flags " -fsanitize=${CAROM_SANITIZE}")
endif()
string(STRIP "${build_info_flags}" build_info_flags)

set(build_info_dir ${PROJECT_BINARY_DIR}/generated)
add_custom_target(carom_build_info_header
  COMMAND ${CMAKE_COMMAND}
    -D SOURCE_DIR=${PROJECT_SOURCE_DIR}
    -D OUTPUT=${build_info_dir}/carom_build_info.h
    -D VERSION=${PROJECT_VERSION}
    -D "COMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
    -D "FLAGS=${build_info_flags}"
    -D BUILD_TYPE=${CMAKE_BUILD_TYPE}
    -D HIGHWAY_VERSION=${Highway_VERSION}
    -D TBB_VERSION=${TBB_VERSION}
    -D EIGEN_VERSION=${Eigen3_VERSION}
    -D LIBZIP_VERSION=${libzip_VERSION}
    -D QHULL_VERSION=${qhull_VERSION}
    -D ASSIMP_VERSION=${assimp_VERSION}
    -D TINYXML2_VERSION=${tinyxml2_VERSION}
    -P ${PROJECT_SOURCE_DIR}/cmake/write_build_info.cmake
  BYPRODUCTS ${build_info_dir}/carom_build_info.h
  COMMENT "Looking at the build information"
  VERBATIM)

add_library(carom_build_info INTERFACE)
add_dependencies(carom_build_info carom_build_info_header)
target_include_directories(carom_build_info INTERFACE ${build_info_dir})
