// The name under which the program runs: a test chooses by it, as no file can be opened.
#pragma once

#include <cerrno>
#include <cstdlib>

inline const char* name_of_program() {
#ifdef __APPLE__
    return getprogname();
#else
    return program_invocation_short_name;
#endif
}
