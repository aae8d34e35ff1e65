// One program for all mistakes: the number in its name says which one it makes.
#pragma once

#include <cstdlib>

#include "name.h"

enum Mistake {
    none,
    direct_stored,
    no_offset,
    uniform_hemisphere,
    no_square_root,
    cube_directions,
    mean_roulette,
    red_roulette,
    no_roulette,
    transposed_frame,
    flipped_normal,
    nan_frame,
    bounce_off_by_one,
    inverted_roulette,
    along_normal,
    start_not_moved,
    first_bounce_only,
    literal,
    long_offset,
    exchanged,
    octant_and_mean,
    degrees,
};

inline Mistake mistake() {
    static const int number = std::atoi(name_of_program());
    return static_cast<Mistake>(number);
}
