# Tests compile a third faster like this; what they test has the flags of its own folder.
add_compile_options(-O1)
# As libraries are compiled, so that precompiled headers fit both.
set(CMAKE_POSITION_INDEPENDENT_CODE OFF)
add_compile_options(-fPIC)
# Fuzzers look for ways through the libraries, not through tests.
if(CAROM_FUZZ)
  add_compile_options(-fno-sanitize=fuzzer-no-link)
endif()
