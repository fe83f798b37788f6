// Nothing: the headers that CMake has precompiled for this file are what other targets use.
