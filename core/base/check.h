#pragma once

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

/// Checks of our own reasoning: a failure is a bug of the program, never of its input. They stay on in
/// Release.
namespace fluxwalk::base::detail {

template <class A, class B>
[[noreturn]] void checkFailed(const char* file, int line, const char* text, const A& a, const B& b) {
    std::ostringstream message;
    message << file << ':' << line << ": check failed: " << text << "  (" << a << " vs " << b << ")\n";
    std::fputs(message.str().c_str(), stderr);
    std::abort();
}

[[noreturn]] inline void checkFailed(const char* file, int line, const char* text) {
    std::fprintf(stderr, "%s:%d: check failed: %s\n", file, line, text);
    std::abort();
}

}  // namespace fluxwalk::base::detail

#define FLUXWALK_CHECK(condition)                                                  \
    do {                                                                           \
        if (!(condition)) {                                                        \
            ::fluxwalk::base::detail::checkFailed(__FILE__, __LINE__, #condition); \
        }                                                                          \
    } while (false)

#define FLUXWALK_CHECK_OP(a, op, b)                                                                       \
    do {                                                                                                  \
        const auto& checkA = (a);                                                                         \
        const auto& checkB = (b);                                                                         \
        if (!(checkA op checkB)) {                                                                        \
            ::fluxwalk::base::detail::checkFailed(__FILE__, __LINE__, #a " " #op " " #b, checkA, checkB); \
        }                                                                                                 \
    } while (false)

#define FLUXWALK_CHECK_EQ(a, b) FLUXWALK_CHECK_OP(a, ==, b)
#define FLUXWALK_CHECK_LT(a, b) FLUXWALK_CHECK_OP(a, <, b)
#define FLUXWALK_CHECK_LE(a, b) FLUXWALK_CHECK_OP(a, <=, b)
