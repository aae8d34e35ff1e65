// Counts directions around an axis over so many calls that angles in degrees show: nobody could
// tell these calls one by one.

#include "recorder.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fcntl.h>
#include <iostream>
#include <unistd.h>

namespace photon_check {
namespace {

// The clock is read this often. As many calls show where a submission draws from.
const std::uint64_t portion = 1024;

std::uint32_t counts[3][around_bins];
std::uint64_t calls = 0;
std::uint64_t rays_of_call = 0;
std::uint64_t drawn_before = 0;
std::clock_t start = 0;
std::chrono::steady_clock::time_point start_on_clock;
double seconds = 0.;
int standard_streams[2] = {-1, -1};

// Whoever makes an engine in every call is slow. They get twice the time where that makes enough
// calls for 360 degrees, and none where one time makes too few for 180 degrees.
bool has_time() {
    const double enough = 900000.;
    const double least = 140000.;
    const std::chrono::duration<double> on_clock =
        std::chrono::steady_clock::now() - start_on_clock;
    // Whoever sleeps uses no processor time.
    if (on_clock.count() > 5. * seconds) {
        return false;
    }
    const double used = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const double made = static_cast<double>(calls);
    const double in_time = made * seconds / used;
    if (used < seconds) {
        return in_time >= least;
    }
    return used < 2. * seconds && made < enough && 2. * in_time >= enough;
}

} // namespace

void begin_around(double of_step) {
    std::fill_n(&counts[0][0], 3 * around_bins, 0u);
    calls = 0;
    drawn_before = numbers_drawn();
    seconds = of_step;
    start = std::clock();
    start_on_clock = std::chrono::steady_clock::now();
    // What is printed in every call is too much.
    std::cout.flush();
    std::fflush(nullptr);
    for (int i = 0; i < 2; ++i) {
        // Above those in which the pipe may be.
        standard_streams[i] = fcntl(i + 1, F_DUPFD, 256);
        if (standard_streams[i] >= 0) {
            close(i + 1);
        }
    }
    set_mode(Mode::around);
}

bool wants_more_around(std::uint64_t numbers_of_direction) {
    rays_of_call = 0;
    if (calls > 0 && calls % portion == 0) {
        if (numbers_drawn() - drawn_before >= numbers_of_direction * calls) {
            // All numbers are known, and so is what follows from them.
            std::fill_n(&counts[0][0], 3 * around_bins, 0u);
            return false;
        }
        if (!has_time()) {
            return false;
        }
    }
    ++calls;
    return true;
}

void count_around(const float* direction, int axis) {
    const float across = direction[(axis + 1) % 3];
    const float along = direction[(axis + 2) % 3];
    const float turn = std::atan2(along, across) / 6.2831853f + 0.5f;
    // A NaN is in no bin.
    if (turn >= 0.f && turn <= 1.f) {
        ++counts[axis][static_cast<std::size_t>(turn * around_bins) % around_bins];
    }
}

void count_second_ray(const float* direction) {
    if (++rays_of_call == 2) {
        count_around(direction, 2);
    }
}

void end_around() {
    set_mode(Mode::silent);
    for (int i = 0; i < 2; ++i) {
        if (standard_streams[i] >= 0) {
            dup2(standard_streams[i], i + 1);
            close(standard_streams[i]);
        }
    }
    std::cout.clear();
    std::cerr.clear();
    for (int axis = 0; axis < 3; ++axis) {
        tell_around(counts[axis]);
    }
}

} // namespace photon_check
