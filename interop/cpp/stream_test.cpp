// Prints what reference_rand.hpp draws, for a test to hold against another ChaCha8.
//
//   stream_test [--rand | --words | --floats] < requests
//
// A request is a line "seed stream count"; its answer is one line of `count` values with single
// spaces between:
//   --rand    rand() in decimal (default)
//   --words   the 32-bit words in decimal
//   --floats  (float)rand() / RAND_MAX in C's hexadecimal notation, as 0x1.8p-1
//
// Every division a student may write is also tried on every value of --floats; one that strays from
// the reference's number by more than a rounding, or reaches 1, ends the program with status 1.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>

#define REFERENCE_RAND_REPLACES_RAND
#include "reference_rand.hpp"

static bool read_number(std::istream& in, std::uint64_t& number) {
    std::string digits;
    // The stream's own conversion takes -1 for 2^64 - 1.
    if (!(in >> digits) || digits.find_first_not_of("0123456789") != std::string::npos) {
        return false;
    }
    std::istringstream conversion(digits);
    return static_cast<bool>(conversion >> number);
}

static bool is_within_a_rounding(float u, float reference) {
    const float ulp = std::numeric_limits<float>::epsilon() / 2.0f * reference;
    return u >= 0.0f && u < 1.0f && std::fabs(u - reference) <= ulp;
}

static bool all_divisions_agree(int drawn, float reference) {
    const float quotients[] = {
        (float)drawn / RAND_MAX,           drawn / (float)RAND_MAX,
        (float)drawn / (float)RAND_MAX,    drawn / (RAND_MAX + 1.0f),
        (float)((double)drawn / RAND_MAX), (float)(drawn / (RAND_MAX + 1.0)),
        (float)drawn * (1.0f / RAND_MAX),  0.5f * ((float)drawn / (RAND_MAX / 2)),
    };
    for (float quotient : quotients) {
        if (!is_within_a_rounding(quotient, reference)) {
            std::fprintf(stderr, "stream_test: rand() = %d gives %a, and the reference has %a\n",
                         drawn, (double)quotient, (double)reference);
            return false;
        }
    }
    return (double)drawn / RAND_MAX < 1.0;
}

int main(int argc, char** argv) {
    const std::string mode = argc == 2 ? argv[1] : "--rand";
    if (argc > 2 || (mode != "--rand" && mode != "--words" && mode != "--floats")) {
        std::fprintf(stderr, "usage: stream_test [--rand | --words | --floats] < requests\n");
        return 2;
    }

    std::string line;
    for (int line_number = 1; std::getline(std::cin, line); ++line_number) {
        std::istringstream request(line);
        std::uint64_t seed, stream, count;
        std::string rest;
        if (!read_number(request, seed) || !read_number(request, stream) ||
            !read_number(request, count) || (request >> rest)) {
            std::fprintf(stderr, "stream_test: line %d is not \"seed stream count\": %s\n",
                         line_number, line.c_str());
            return 2;
        }

        reference_rand::begin_photon(seed, stream);
        for (std::uint64_t i = 0; i < count; ++i) {
            const char* const separator = i == 0 ? "" : " ";
            if (mode == "--words") {
                std::printf("%s%lu", separator,
                            static_cast<unsigned long>(reference_rand::next_word()));
                continue;
            }
            // In turn, so that both spellings are held to the same answer.
            const int drawn = i % 2 == 0 ? rand() : std::rand();
            if (mode == "--rand") {
                std::printf("%s%d", separator, drawn);
                continue;
            }
            if (!all_divisions_agree(drawn, static_cast<float>(drawn >> 7) / 16777216.0f)) {
                return 1;
            }
            std::printf("%s%a", separator, (double)((float)drawn / RAND_MAX));
        }
        std::printf("\n");
    }
    return 0;
}
