// The reference's random numbers behind every function from which a student may draw.
//
// A function that the program itself has takes precedence over the C library's. So rand(),
// std::rand, function pointers and glm's helpers all end here, and no file is changed.

#include <cstdlib>
#include <ctime>
#include <random>
#include <set>
#include <sys/types.h>
#include <unistd.h>

#include "recorder.hpp"
#include "reference_rand.hpp"

#ifdef __GLIBC__
#define NO_THROW noexcept
#else
#define NO_THROW
#endif

namespace photon_check {
namespace {

struct Numbers {
    Numbers() : scripted(nullptr), scripted_left(0), drawn(0), again(0) {
        // What is drawn before any photon, as in a static constructor, comes from the last stream.
        stream.select(148, ~0ull);
    }

    reference_rand::detail::ChaCha stream;
    const std::uint32_t* scripted;
    std::size_t scripted_left;
    std::uint64_t drawn;
    std::set<long> seeds;
    std::uint32_t again;
};

Numbers& numbers() {
    static Numbers of_program;
    return of_program;
}

// The next number in units of 2^-31, of which the last seven bits are no part of the reference's.
std::uint32_t draw() {
    Numbers& all = numbers();
    ++all.drawn;
    if (all.scripted_left > 0) {
        --all.scripted_left;
        return *all.scripted++ << 7;
    }
    const std::uint32_t word = all.stream.next_word();
    // Six bits more, for those who take the remainder, as in rand() % 100. With them, a float still
    // does not round up to 1.
    return (word >> 8 << 7) | (word & 63);
}

// Divided by RAND_MAX, as float or double, this is the reference's number, to 3e-8, and never 1.
int draw_int() { return static_cast<int>(draw()); }
double draw_double() { return (draw() >> 7) / 16777216.0; }

// The numbers go on as they would. Whoever seeds with the time for every photon gets the same ones
// again and again elsewhere.
void seed_with(long seed) {
    const std::size_t enough = 100000;
    Numbers& all = numbers();
    if (all.seeds.size() < enough && !all.seeds.insert(seed).second) {
        ++all.again;
    }
}

} // namespace

void begin_numbers(std::uint64_t seed, std::uint64_t photon, const std::uint32_t* scripted,
                   std::size_t count) {
    Numbers& all = numbers();
    all.stream.select(seed, photon);
    all.scripted = scripted;
    all.scripted_left = count;
}

std::uint64_t numbers_drawn() { return numbers().drawn; }
std::uint32_t seeds_again() { return numbers().again; }
void forget_seeds() { numbers().seeds.clear(); }

} // namespace photon_check

using photon_check::draw_double;
using photon_check::draw_int;
using photon_check::notice;
using photon_check::seed_with;

extern "C" {

int rand() NO_THROW { return draw_int(); }
void srand(unsigned seed) NO_THROW { seed_with(seed); }
int rand_r(unsigned*) NO_THROW { return draw_int(); }
long random() NO_THROW { return draw_int(); }
void srandom(unsigned seed) NO_THROW { seed_with(seed); }
double drand48() NO_THROW { return draw_double(); }
double erand48(unsigned short*) NO_THROW { return draw_double(); }
long lrand48() NO_THROW { return draw_int(); }
long nrand48(unsigned short*) NO_THROW { return draw_int(); }
void srand48(long seed) NO_THROW { seed_with(seed); }

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
    return photon_check::numbers().stream.next_word();
}
#endif
