/// @file
/// The macro that marks the exported names of the shared libraries.
#pragma once

/// @def CAROM_EXPORT
/// Marks what the shared libraries export; everything else is hidden. Users of the static
/// libraries get CAROM_STATIC from the CMake package or from pkg-config.
#if defined(CAROM_STATIC)
#define CAROM_EXPORT
#else
#define CAROM_EXPORT __attribute__((visibility("default")))
#endif
