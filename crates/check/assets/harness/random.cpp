// The reference's random numbers behind every function from which a student may draw.
//
// A function that the program itself has takes precedence over the C library's. So rand(),
// std::rand, function pointers and glm's helpers all end here, and no file is changed.
//
// The generator is ChaCha with 8 rounds: the quarter round of RFC 8439 (section 2.1) and the state
// layout of D. J. Bernstein, "ChaCha, a variant of Salsa20" (2008), with a 64-bit block counter and
// a 64-bit stream number. The key is the seed, the stream is the photon's number.

#include <cstdlib>
#include <ctime>
#include <random>
#include <sys/types.h>
#include <unistd.h>

#include "recorder.hpp"

#ifdef __GLIBC__
#define NO_THROW noexcept
#else
#define NO_THROW
#endif

namespace photon_check {
namespace {

struct Numbers {
    std::uint64_t seed;
    std::uint64_t photon;
    std::uint64_t block;
    unsigned next;
    std::uint32_t words[16];
    const std::uint32_t* scripted;
    std::size_t scripted_left;
    std::uint64_t drawn;
};

// What is drawn before any photon, as in a static constructor, comes from the last stream.
Numbers numbers = {148, ~0ull, 0, 16, {}, nullptr, 0, 0};

std::uint32_t rotate_left(std::uint32_t word, int bits) {
    return (word << bits) | (word >> (32 - bits));
}

void quarter_round(std::uint32_t& a, std::uint32_t& b, std::uint32_t& c, std::uint32_t& d) {
    a += b;
    d = rotate_left(d ^ a, 16);
    c += d;
    b = rotate_left(b ^ c, 12);
    a += b;
    d = rotate_left(d ^ a, 8);
    c += d;
    b = rotate_left(b ^ c, 7);
}

std::uint32_t low(std::uint64_t number) { return static_cast<std::uint32_t>(number); }
std::uint32_t high(std::uint64_t number) { return static_cast<std::uint32_t>(number >> 32); }

void next_block() {
    const std::uint32_t input[16] = {
        0x61707865u, 0x3320646eu, 0x79622d32u, 0x6b206574u, low(numbers.seed), high(numbers.seed),
        0, 0, 0, 0, 0, 0,
        low(numbers.block), high(numbers.block), low(numbers.photon), high(numbers.photon)};
    std::uint32_t w[16];
    for (int i = 0; i < 16; ++i) {
        w[i] = input[i];
    }
    for (int two_rounds = 0; two_rounds < 4; ++two_rounds) {
        for (int i = 0; i < 4; ++i) {
            quarter_round(w[i], w[4 + i], w[8 + i], w[12 + i]);
        }
        for (int i = 0; i < 4; ++i) {
            quarter_round(w[i], w[4 + (i + 1) % 4], w[8 + (i + 2) % 4], w[12 + (i + 3) % 4]);
        }
    }
    for (int i = 0; i < 16; ++i) {
        numbers.words[i] = w[i] + input[i];
    }
    ++numbers.block;
    numbers.next = 0;
}

std::uint32_t next_word() {
    if (numbers.next == 16) {
        next_block();
    }
    return numbers.words[numbers.next++];
}

// The next number in units of 2^-31, of which the last seven bits are no part of the reference's.
std::uint32_t draw() {
    ++numbers.drawn;
    if (numbers.scripted_left > 0) {
        --numbers.scripted_left;
        return *numbers.scripted++ << 7;
    }
    const std::uint32_t word = next_word();
    // Six bits more, for those who take the remainder, as in rand() % 100. With them, a float still
    // does not round up to 1.
    return (word >> 8 << 7) | (word & 63);
}

// Divided by RAND_MAX, as float or double, this is the reference's number, to 3e-8, and never 1.
int draw_int() { return static_cast<int>(draw()); }
double draw_double() { return (draw() >> 7) / 16777216.0; }

} // namespace

void begin_numbers(std::uint64_t seed, std::uint64_t photon, const std::uint32_t* scripted,
                   std::size_t count) {
    numbers.seed = seed;
    numbers.photon = photon;
    numbers.block = 0;
    numbers.next = 16;
    numbers.scripted = scripted;
    numbers.scripted_left = count;
}

std::uint64_t numbers_drawn() { return numbers.drawn; }

} // namespace photon_check

using photon_check::draw_double;
using photon_check::draw_int;
using photon_check::notice;

extern "C" {

int rand() NO_THROW { return draw_int(); }
void srand(unsigned) NO_THROW { notice(photon_check::srand_called); }
int rand_r(unsigned*) NO_THROW { return draw_int(); }
long random() NO_THROW { return draw_int(); }
void srandom(unsigned) NO_THROW { notice(photon_check::srand_called); }
double drand48() NO_THROW { return draw_double(); }
double erand48(unsigned short*) NO_THROW { return draw_double(); }
long lrand48() NO_THROW { return draw_int(); }
long nrand48(unsigned short*) NO_THROW { return draw_int(); }
void srand48(long) NO_THROW { notice(photon_check::srand_called); }

// The time seeds generators. With a fixed one, every run is the same.
std::time_t time(std::time_t* out) NO_THROW {
    const std::time_t fixed = 1574665200;
    if (out != nullptr) {
        *out = fixed;
    }
    return fixed;
}

// New processes are refused; see guard.cpp.
pid_t fork() NO_THROW {
    notice(photon_check::process_started);
    return -1;
}
int system(const char*) {
    notice(photon_check::process_started);
    return -1;
}

} // extern "C"

#ifdef __GLIBCXX__
// The device's numbers come from the photon's stream too: this is quick, and every run is the same.
void std::random_device::_M_init(const std::string&) {}
void std::random_device::_M_fini() {}
std::random_device::result_type std::random_device::_M_getval() {
    notice(photon_check::random_device_read);
    return photon_check::next_word();
}
#endif
