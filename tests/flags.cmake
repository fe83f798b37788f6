# Tests compile a third faster like this; what they test has the flags of its own folder.
# What AddressSanitizer adds to every access makes optimizing it slow: there, without.
if(CAROM_SANITIZE MATCHES "address")
  add_compile_options(-O0 -UEIGEN_STRONG_INLINE)
else()
  add_compile_options(-O1)
endif()
# As libraries are compiled, so that precompiled headers fit both.
set(CMAKE_POSITION_INDEPENDENT_CODE OFF)
add_compile_options(-fPIC)
# Fuzzers look for ways through the libraries, not through tests.
if(CAROM_FUZZ)
  add_compile_options(-fno-sanitize=fuzzer-no-link)
endif()
