// Nothing: its headers are what is compiled, see precompiled.cmake.
