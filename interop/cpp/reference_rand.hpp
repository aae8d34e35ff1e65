// The reference's random numbers behind rand(): with them, a C++ photon mapper that draws in the
// reference's order traces the reference's photons, and its list can be compared record by record.
//
//   #define REFERENCE_RAND_REPLACES_RAND   // optional: rand() and std::rand() below are these
//   #include "reference_rand.hpp"          // the last include of the file
//
//   reference_rand::begin_photon(seed, i); // before photon i, counted from 0 over all lights
//   float u = (float)rand() / RAND_MAX;    // the reference's number, to the last bit, and never 1
//
// The generator is ChaCha with 8 rounds: the quarter round of RFC 8439 (section 2.1), and the state
// layout of D. J. Bernstein, "ChaCha, a variant of Salsa20" (2008): a 64-bit block counter and a
// 64-bit stream number, where the RFC has 32 and 96 bits. The key is the seed in little-endian
// order, filled up with zeros; the stream is the photon's number. So photon i's numbers depend on
// no other photon: order, threads and the draws of the neighbors do not matter.

#ifndef REFERENCE_RAND_HPP
#define REFERENCE_RAND_HPP

// Both spellings, before any macro: a later first sight of the declaration `int rand(void)` would
// be rewritten too.
#include <cstdlib>
#include <stdlib.h>

#include <cstdint>
#include <cstdio>
#include <stdint.h>

// Shared by photon_dump.hpp and reference_rand.hpp, whichever comes first.
#ifndef PHOTON_NUMBERS
#define PHOTON_NUMBERS
namespace photon_numbers {
// How many numbers reference_rand.hpp gave this thread's photon, if it gives any.
struct Drawn {
    bool is_counted;
    std::uint64_t numbers;
};
inline Drawn& drawn() {
    static thread_local Drawn of_thread = {false, 0};
    return of_thread;
}
} // namespace photon_numbers
#endif

namespace reference_rand {

// RAND_MAX as glibc has it. As a float it rounds up to 2^31, which is what makes (float)rand() /
// RAND_MAX exact.
const std::int32_t rand_max = 2147483647;

namespace detail {

inline std::uint32_t rotate_left(std::uint32_t word, int bits) {
    return (word << bits) | (word >> (32 - bits));
}

inline void quarter_round(std::uint32_t& a, std::uint32_t& b, std::uint32_t& c, std::uint32_t& d) {
    a += b;
    d = rotate_left(d ^ a, 16);
    c += d;
    b = rotate_left(b ^ c, 12);
    a += b;
    d = rotate_left(d ^ a, 8);
    c += d;
    b = rotate_left(b ^ c, 7);
}

inline std::uint32_t low_half(std::uint64_t number) {
    return static_cast<std::uint32_t>(number & 0xffffffffu);
}
inline std::uint32_t high_half(std::uint64_t number) {
    return static_cast<std::uint32_t>(number >> 32);
}

// One stream of numbers at a time. `photon-mapping check` draws from it, too.
class ChaCha {
public:
    ChaCha() : seed_(0), number_(0), block_(0), used_(words_per_block) {}

    void select(std::uint64_t seed, std::uint64_t number) {
        seed_ = seed;
        number_ = number;
        block_ = 0;
        used_ = words_per_block;
    }

    std::uint64_t number() const { return number_; }
    bool has_drawn() const { return block_ != 0; }

    std::uint32_t next_word() {
        if (used_ == words_per_block) {
            fill_block();
            used_ = 0;
        }
        return words_[used_++];
    }

private:
    static const int words_per_block = 16;
    static const int double_rounds = 4;

    void fill_block() {
        const std::uint32_t input[words_per_block] = {
            0x61707865u,
            0x3320646eu,
            0x79622d32u,
            0x6b206574u, // "expand 32-byte k"
            low_half(seed_),
            high_half(seed_),
            0,
            0,
            0,
            0,
            0,
            0,
            low_half(block_),
            high_half(block_),
            low_half(number_),
            high_half(number_),
        };
        std::uint32_t w[words_per_block];
        for (int i = 0; i < words_per_block; ++i) {
            w[i] = input[i];
        }
        for (int round = 0; round < double_rounds; ++round) {
            quarter_round(w[0], w[4], w[8], w[12]);
            quarter_round(w[1], w[5], w[9], w[13]);
            quarter_round(w[2], w[6], w[10], w[14]);
            quarter_round(w[3], w[7], w[11], w[15]);
            quarter_round(w[0], w[5], w[10], w[15]);
            quarter_round(w[1], w[6], w[11], w[12]);
            quarter_round(w[2], w[7], w[8], w[13]);
            quarter_round(w[3], w[4], w[9], w[14]);
        }
        for (int i = 0; i < words_per_block; ++i) {
            words_[i] = w[i] + input[i];
        }
        ++block_;
    }

    std::uint64_t seed_;
    std::uint64_t number_;
    std::uint64_t block_;
    int used_;
    std::uint32_t words_[words_per_block];
};

// The numbers of a photon, with a complaint where they are not what a student expects.
class Stream {
public:
    Stream() : is_selected_(false), is_warned_(false) {}

    void select(std::uint64_t seed, std::uint64_t number) {
        if (is_selected_ && !numbers_.has_drawn() && !is_warned_) {
            // Going on silently would give a plausible picture that agrees with nothing.
            std::fprintf(stderr,
                         "reference_rand: photon %llu drew no number here: glm::linearRand, <random> "
                         "and other files draw from elsewhere\n",
                         static_cast<unsigned long long>(numbers_.number()));
            is_warned_ = true;
        }
        photon_numbers::drawn().is_counted = true;
        photon_numbers::drawn().numbers = 0;
        numbers_.select(seed, number);
        is_selected_ = true;
    }

    std::uint32_t next_word() {
        if (!is_selected_) {
            // Going on silently would give a plausible picture that agrees with nothing.
            std::fprintf(stderr,
                         "reference_rand: a number was drawn on this thread before begin_photon(); "
                         "using photon 0 of seed 0\n");
            is_selected_ = true;
        }
        ++photon_numbers::drawn().numbers;
        return numbers_.next_word();
    }

private:
    ChaCha numbers_;
    bool is_selected_;
    bool is_warned_;
};

// One stream per thread: rand() takes no argument, so it must find the current photon by itself,
// and threads that trace different photons must not draw from each other's. A static inside an
// inline function is also the only C++11 way for two source files (light and renderer) to share it
// without a file of ours to link.
inline Stream& this_threads_stream() {
    static thread_local Stream stream;
    return stream;
}

} // namespace detail

// Goes to the start of photon i's numbers. To be called on the thread that traces the photon.
inline void begin_photon(std::uint64_t seed, std::uint64_t i) {
    detail::this_threads_stream().select(seed, i);
}

// The next 32 bits as they come.
inline std::uint32_t next_word() { return detail::this_threads_stream().next_word(); }

// The next number in [0, 1), 24 bits: all that a float holds at 1/2 and above.
inline float uniform() { return static_cast<float>(next_word() >> 8) * (1.0f / 16777216.0f); }

// The next number as an int in [0, 2^31 - 128].
//
// Its seven lowest bits are zero on purpose. A 31-bit int does not fit a float, so rounding
// (float)rand() could reach 2^31, and the quotient 1.0; these 24 bits fit, and divided by
// (float)RAND_MAX = 2^31 they are uniform() exactly. In double the divisor is 2^31 - 1, and the
// quotient 5e-10 too large in proportion: it rounds to the same float. The price: rand() % n sees
// few of the bits. Divide, do not take remainders.
inline int rand() { return static_cast<int>((next_word() >> 8) << 7); }

// What the replacement below makes of `rand`.
inline int reference_rand_draw() { return rand(); }

} // namespace reference_rand

using reference_rand::reference_rand_draw;
namespace std {
using ::reference_rand::reference_rand_draw;
}

#endif // REFERENCE_RAND_HPP

// Outside the guard, for a file that asks for the replacement after some other header has included
// this one without.
#if defined(REFERENCE_RAND_REPLACES_RAND) && !defined(REFERENCE_RAND_REPLACED_RAND)
#define REFERENCE_RAND_REPLACED_RAND

// The name alone, so that rand(), std::rand(), pointers to it, members of that name and helpers such
// as rand(a, b) all compile.
#undef rand
#define rand reference_rand_draw

// Some libraries have 32767, and the quotient must be taken by the maximum of the numbers that are
// drawn.
#undef RAND_MAX
#define RAND_MAX 2147483647

#endif
